"""Torsion: the turns wound into the joints of a sculpture, and how those that nothing holds come undone.

The rubber of a wound neck is a rod that springs back. Both parts of the sculpture turn against each other, as
fast as the inertia of their rubber and gas and the drag of the air allow, and so that neither momentum nor
angular momentum changes. Down to half a turn the neck stays closed; then its
meridians open as a hyperboloid does, and the gas of both bubbles joins.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.bubble_shape import neck_rubber, neck_rubber_of_length
from balloon_usd.balloon.wound_neck import drawing_torque, drawn_rubber, wound_rigidity
from balloon_usd.operations.moves import Weld
from balloon_usd.plan.open_tube import softened
from balloon_usd.solver.latex.hinge import Hinge

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from balloon_usd.plan import Plan
    from balloon_usd.plan.holding import LooseJoint
    from balloon_usd.plan.strip import Strip
    from balloon_usd.solver.latex.controls import LatexControls
    from balloon_usd.solver.latex.friction import Friction
    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.latex.struts import Struts

Floats = NDArray[np.float32]

FULL_TURN = 2.0 * math.pi
CLOSED_ANGLE = math.pi
"""Wound angle from which a neck is closed, rad: the meridians of a tube turned by half a turn meet."""
OPEN_ANGLE = 0.05 * FULL_TURN
"""Wound angle at which a neck is as good as its tube, rad: its waist is 99 % as wide."""
STEPS = 16
"""Steps in a frame in which the unwinding of a joint is followed."""
MOST_ANGLE = 2.6
"""Largest angle by which both parts turn against each other in a frame, rad: from half a turn on it would be
seen as a turn the other way.
"""
FASTEST_WALL = 1.0
"""Largest speed of a wall that turns with what unwinds, m/s: three turns between two bubbles of a 260 take a
third of a second, of a long arm some seconds. Without it a tree of 24 bubbles was thrown about at 5 m/s.
"""


@dataclass
class WoundJoint:
    """A joint and the turns that are wound into it."""

    strip: Strip
    """Its balloon."""
    bubble: str
    """The bubble before it."""
    neck: float
    """Radius of the closed neck, m."""
    wide: float
    """Radius of the tube before it was pinched, m."""
    planned: float
    """Unstressed rubber that its turns are planned to draw in, m."""
    turns: float = 0.0
    """Full turns of what lies beyond, seen against what lies before; signed."""
    rate: float = 0.0
    """Turns in a second."""
    held: bool = True
    """Whether hands, a lock or a ring that a lock closes keep it from unwinding."""

    @cached_property
    def stiffness(self) -> float:
        """Torque for each radian of what it hides alone, N m."""
        return rope_stiffness(self.strip, self.bubble, self.neck)

    @cached_property
    def most_torque(self) -> float:
        """Torque at which turns draw rubber in, N m."""
        return drawing_torque(self.strip.size, softened(self.strip.rubber))

    @property
    def torque(self) -> float:
        """Torque with which it would unwind, N m (Rivlin 1949), up to that at which turns draw rubber in."""
        return math.copysign(min(self.stiffness * self.angle, self.most_torque), self.turns)

    @property
    def drawn(self) -> float:
        """Share of what its turns are planned to draw in that is drawn in; 0 where that is nothing."""
        if self.planned == 0.0:
            return 0.0
        return drawn_rubber(self.strip.size, softened(self.strip.rubber), self.turns) / self.planned

    @property
    def angle(self) -> float:
        """Wound angle without its sense, rad."""
        return FULL_TURN * abs(self.turns)

    @property
    def waist(self) -> float:
        """Radius to which its meridians, as inextensible strings, have opened, m."""
        return self.wide * math.cos(0.5 * min(self.angle, CLOSED_ANGLE))

    def spring_back(self, inertia: float, drag: float, fastest: float, seconds: float) -> float:
        """Let it spring back for a while; return by which angle what lies beyond has turned (rad).

        `inertia`: of both parts against each other, kg m2; `drag`: rate at which the air brakes, 1/s;
        `fastest`: largest rate, rad/s.
        """
        before = self.turns
        self.rate -= self.torque / (inertia * FULL_TURN) * seconds
        self.rate *= math.exp(-drag * seconds)
        self.rate = min(max(self.rate, -fastest / FULL_TURN), fastest / FULL_TURN)
        self.turns += self.rate * seconds
        if self.turns * before <= 0.0 or self.angle < OPEN_ANGLE:
            self.turns = self.rate = 0.0
        return FULL_TURN * (self.turns - before)


@dataclass
class _Loose:
    """A joint that unwinds."""

    name: str
    ring: int
    """Of the plan."""
    joint: int
    """Of the scene."""
    hinge: Hinge
    open: bool = False
    """Whether its neck is open."""


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
        self._loose: list[_Loose] = []

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
    def unwinding(self) -> str | None:
        """Name of the joint that is unwinding, or None."""
        return self._loose[0].name if self._loose else None

    def let_go(self, struts: Struts) -> None:
        """Take the hands from a finished sculpture: locks of too few turns slip, lone twists spring back."""
        welds = [move for move in self.plan.choreography.moves if isinstance(move, Weld)]
        slipping = [move for move in welds if move.step in self.plan.slipping]
        if slipping:
            self._slip(slipping, [move for move in welds if move.step not in self.plan.slipping], struts)
        found = [self._loosened(loose) for loose in self.plan.loose]
        # One after another: those of the fewest turns first, and those nearest to the tip.
        # Turns are added up frame by frame: rounding must not decide.
        found.sort(key=lambda loose: (round(abs(self.joints[loose.ring].turns), 3), -loose.ring))
        self._loose = found
        for loose in found:
            self.joints[loose.ring].held = False

    def _slip(self, slipping: Iterable[Weld], holding: Iterable[Weld], struts: Struts) -> None:
        self.hands.part(self._ring)
        for move in holding:
            self.hands.weld(tuple(self._ring[r] for r in move.rings))
        struts.release(set(self._ring), self._friction.pairs(self.hands))
        names = [" = ".join(self.plan.table.rings[r].name for r in move.rings) for move in slipping]
        self.undone = (*self.undone, *names)

    def _loosened(self, loose: LooseJoint) -> _Loose:
        ring = self.plan.table.joint(loose.end)
        assert ring is not None, "two bubbles meet in a loose joint"
        own, along = self.plan.table.rings[ring].balloon, self.plan.table.rings[ring].along
        # Every other balloon lies wholly on one side, or hangs together with neither.
        beyond = {own: along}
        for name, strip in self.plan.strips.items():
            bubble = strip.bubbles[0].name
            if name != own and bubble in loose.beyond | loose.before:
                beyond[name] = -math.inf if bubble in loose.beyond else math.inf
        places = {self._body[name]: place for name, place in beyond.items()}
        hinge = Hinge(self.scene, places, self._segments(own, loose.end.bubble))
        return _Loose(str(loose.end), ring, self._ring[ring], hinge)

    def _segments(self, balloon: str, bubble: str) -> tuple[int, int]:
        """Segments of the scene before and beyond the end of a bubble."""
        names = [planned.name for planned in self.plan.strips[balloon].bubbles]
        first = int(self.scene.bubbles_of(self._body[balloon])[0]) + names.index(bubble)
        return first, first + 1

    def unwind(self, seconds: float, middle: Floats) -> None:
        """Let the next loose joint unwind in the coming frame; `middle`: of all joints, (J, 3), m."""
        if not self._loose:
            return
        loose = self._loose[0]
        wound = self.joints[loose.ring]
        parts, light = loose.hinge.parts(self.hands.places, middle[loose.joint]), loose.hinge.lightness
        drag, fastest = self.scene.settings.drag, MOST_ANGLE / seconds
        reach = loose.hinge.reach(self.hands.places, middle[loose.joint], parts.response()[1])
        fastest = min(fastest, FASTEST_WALL / reach)
        for _ in range(STEPS):
            inertia, motion = parts.response()
            parts.move(motion, wound.spring_back(light * inertia, drag, fastest, seconds / STEPS))
        loose.hinge.follow(self.hands, parts, seconds)
        self.hands.draw_rubber(loose.joint, wound.drawn)
        if wound.angle < CLOSED_ANGLE and not loose.open:
            loose.open = True
            self.undone = (*self.undone, loose.name)
        self._widen(loose, wound)
        if wound.turns == 0.0:
            self._loose.pop(0)

    def _widen(self, loose: _Loose, wound: WoundJoint) -> None:
        # No wider than the smaller bubble beside it could be.
        smaller = float(self.hands.volume[self.hands.beside[loose.joint]].min())
        ball = (3.0 * max(smaller, 0.0) / (4.0 * math.pi)) ** (1.0 / 3.0)
        radius = max(wound.neck, min(wound.waist, ball))
        if wound.turns == 0.0:
            self.hands.free_neck(loose.joint)
        else:
            self.hands.squeeze(loose.joint, radius, math.pi * (radius**2 - wound.neck**2))
            closed = (wound.wide - radius) / (wound.wide - wound.neck)
            self.hands.hide_rubber(loose.joint, min(max(closed, 0.0), 1.0))


def rope_stiffness(strip: Strip, bubble: str, neck: float) -> float:
    """Return the torque for each radian (N m) of the wound neck behind a bubble; `neck`: its radius, m.

    The rubber that it hides is a rod of the wall's cross-section.
    """
    at = next(k for k, planned in enumerate(strip.bubbles) if planned.name == bubble)
    rubber = softened(strip.rubber)
    balls = strip.balls()
    length = 0.0
    for k, planned in enumerate(strip.bubbles[at : at + 2], at):
        if k in balls:
            length += neck_rubber_of_length(strip.size, rubber, planned.length, neck)
        else:
            length += neck_rubber(strip.size, rubber, planned.wall_length, neck)
    return wound_rigidity(strip.size, strip.rubber) / length
