"""Torsion: the turns wound into the joints of a sculpture, and how those that nothing holds come undone.

The rubber of a wound neck is a rod that springs back, and both sides of it turn against each other. Down to
half a turn the neck stays closed; then its meridians open as a hyperboloid does, and the gas of both bubbles
joins.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations.moves import Weld
from balloon_usd.solver.latex.turning_with import turning_with
from balloon_usd.solver.latex.unwinding import LooseNeck, Unwinding
from balloon_usd.solver.latex.wound_joint import CLOSED_ANGLE, WoundJoint

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from balloon_usd.plan import Plan
    from balloon_usd.plan.holding import LooseJoint
    from balloon_usd.solver.latex.controls import LatexControls
    from balloon_usd.solver.latex.friction import Friction
    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.latex.struts import Struts

Floats = NDArray[np.float32]


class Torsion:
    """The wound joints of one sculpture."""

    def __init__(
        self,
        plan: Plan,
        scene: LatexScene,
        hands: LatexControls,
        rings: Sequence[int],
        bodies: Mapping[str, int],
        friction: Friction,
    ) -> None:
        """Nothing is wound yet; `rings`: joint of the scene of every planned ring."""
        self.plan = plan
        self.scene = scene
        self.hands = hands
        self._ring = rings
        self._body = bodies
        self._friction = friction
        self.joints: dict[int, WoundJoint] = {}
        """By ring of the plan."""
        self.undone: tuple[str, ...] = ()
        """Locks that have slipped and joints whose necks have opened again, in that order."""
        self._unwinding: list[Unwinding] = []
        """Figures with joints that unwind."""

    def pinch(self, ring: int, wide: float) -> None:
        """Take note of a neck that is about to be closed; `wide`: radius of its tube, m."""
        planned = self.plan.table.rings[ring]
        neck = float(self.hands.neck[self._ring[ring]])
        strip = self.plan.strips[planned.balloon]
        drawn = next(b.drawn[1] for b in strip.bubbles if b.name == planned.bubble)
        self.joints[ring] = WoundJoint(strip, planned.bubble, neck, wide, drawn)

    def wind(self, ring: int, turns: float) -> None:
        """Wind a joint by some more full turns; those that pack the neck no more draw rubber in."""
        self.joints[ring].turns += turns
        self.hands.draw_rubber(self._ring[ring], self.joints[ring].drawn)

    @property
    def unwinding(self) -> tuple[str, ...]:
        """Names of the joints that are unwinding."""
        return tuple(neck.name for figure in self._unwinding for neck in figure.necks)

    def let_go(self, struts: Struts) -> None:
        """Take the hands from a finished sculpture: locks of too few turns slip, lone twists spring back."""
        welds = [move for move in self.plan.choreography.moves if isinstance(move, Weld)]
        slipping = [move for move in welds if move.step in self.plan.slipping]
        if slipping:
            self._slip(slipping, [move for move in welds if move.step not in self.plan.slipping], struts)
        for figure, joints in _by_figure(self.plan.loose).items():
            self._unwinding.append(self._loosened(figure, joints))

    def _slip(self, slipping: Iterable[Weld], holding: Iterable[Weld], struts: Struts) -> None:
        self.hands.part(self._ring)
        for move in holding:
            self.hands.weld(tuple(self._ring[r] for r in move.rings))
        struts.release(set(self._ring), self._friction.pairs(self.hands))
        names = [" = ".join(self.plan.table.rings[r].name for r in move.rings) for move in slipping]
        self.undone = (*self.undone, *names)

    def _loosened(self, figure: frozenset[str], joints: Sequence[LooseJoint]) -> Unwinding:
        """Return what unwinds of a figure, all bubbles that hang together."""
        loose = []
        for joint in joints:
            ring = self.plan.table.joint(joint.end)
            assert ring is not None, "two bubbles meet in a loose joint"
            self.joints[ring].held = False
            loose.append(LooseNeck(str(joint.end), self._ring[ring], self.joints[ring]))
        vertices, bubble = self._turning(figure)
        beyond = np.stack([np.isin(bubble, sorted(joint.beyond)) for joint in joints])
        return Unwinding(self.scene, self.hands, loose, vertices, beyond)

    def _turning(self, figure: frozenset[str]) -> tuple[NDArray[np.int64], NDArray[np.str_]]:
        """Return the vertices of the scene that turn with any bubble of a figure, and with which, (V,)."""
        vertices, bubbles = [], []
        for name, body in self._body.items():
            bubble = turning_with(self.plan, name, self.scene.bodies[body].along)
            own = np.flatnonzero(np.isin(bubble, sorted(figure)))
            vertices.append(own + self.scene.vertices_of(body).start)
            bubbles.append(bubble[own])
        return np.concatenate(vertices), np.concatenate(bubbles)

    def unwind(self, seconds: float, middle: Floats) -> None:
        """Let all loose joints unwind in the coming frame; `middle`: of all joints, (J, 3), m."""
        for figure in self._unwinding:
            for neck in figure.necks:
                neck.wound.pressure = float(self.hands.pressure[self.hands.beside[neck.joint]].min())
            for neck in figure.advance(seconds, middle):
                wound = neck.wound
                self.hands.draw_rubber(neck.joint, wound.drawn)
                if wound.angle < CLOSED_ANGLE and neck.name not in self.undone:
                    self.undone = (*self.undone, neck.name)
                self._widen(neck.joint, wound)
        self._unwinding = [figure for figure in self._unwinding if figure.necks]

    def _widen(self, joint: int, wound: WoundJoint) -> None:
        # No wider than the smaller bubble beside it could be.
        smaller = float(self.hands.volume[self.hands.beside[joint]].min())
        ball = (3.0 * max(smaller, 0.0) / (4.0 * math.pi)) ** (1.0 / 3.0)
        radius = max(wound.neck, min(wound.waist, ball))
        if wound.turns == 0.0:
            self.hands.free_neck(joint)
        else:
            self.hands.squeeze(joint, radius, math.pi * (radius**2 - wound.neck**2))
            closed = (wound.wide - radius) / (wound.wide - wound.neck)
            self.hands.hide_rubber(joint, min(max(closed, 0.0), 1.0))


def _by_figure(loose: Iterable[LooseJoint]) -> dict[frozenset[str], list[LooseJoint]]:
    """Return loose joints by the bubbles that hang together with them."""
    found: dict[frozenset[str], list[LooseJoint]] = {}
    for joint in loose:
        found.setdefault(joint.before | joint.beyond, []).append(joint)
    return found
