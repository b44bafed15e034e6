"""Setting a limb between others, which hold it by their walls."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.language.joint import ends_of
from balloon_usd.solver.latex.led_limb import LedLimb, hold_figure
from balloon_usd.solver.latex.motions.into_ring import PUSHING, SPREADING
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import turn_about, turn_between, unit

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.operations.workpiece import Workpiece
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]

ROOM = 1.1
"""Room that hands make for the limb, in what walls need that just touch."""
EDGEWISE = 0.5 * math.pi
"""Turn of a limb about itself after which it is edgewise, rad."""
SPREAD = 0.5
"""How far hands spread each of those between which it is set, at most, in their widths."""
BESIDE = 0.5
"""Distance of its joint from the place between both, in their widths, below which both are beside it."""
BEYOND = math.radians(25.0)
"""How far it is pressed beyond its place: without it, ears come no nearer than 25 degrees to it."""
OVER = 0.5
"""Share of the time in which the limb is brought over those between which it is set, and they are spread."""
IN = 0.8
"""Share at which it is in, and they are let close."""


class Tuck(Motion):
    """A limb that is led about its joint over two others and in between them, or into the hole of one."""

    def __init__(self, move: moves.Tuck, sculpture: LatexSculpture) -> None:
        """Take hold of the limb, of those between which it is set, and of all the rest."""
        piece = sculpture.plan.recipe.piece.after(move.step)
        limb = piece.limb(move.bubble, move.between)
        assert limb is not None, "what is set between others hangs on a joint"
        self._limb, self._hands = LedLimb(sculpture, piece, limb), sculpture.hands
        sides = _sides(piece, move, sculpture)
        hold_figure(sculpture)
        self._limb.take(PUSHING)
        held = sculpture.plan.table.joint(limb.joint)
        assert held is not None, "it hangs on no tip"
        self._carried = sculpture.carry((*(ring for side in sides for ring in side), held))
        self._spread = [np.array([sculpture.joints[ring] for ring in side]) for side in sides]
        for side in self._spread:
            self._hands.lead_firmly(side, SPREADING)
        middle = sculpture.frame.middle.astype(np.float64)
        self._began = [middle[side] for side in self._spread]
        one, other = (places.mean(axis=0) for places in self._began)
        gap = float(np.linalg.norm(other - one))
        self._aside = (other - one) / max(gap, 1e-9)
        """Unit direction from the one to the other."""
        self._arm = self._limb.way_to(self._limb.outer(move.bubble))
        """Unit direction from its joint to the middle of the limb."""
        self._over, self._in = self._ways(0.5 * (one + other) - self._limb.base, move)
        self._spin, wide = self._edgewise(0.5 * move.width)
        room = ROOM * (wide + move.width + move.tube) - gap
        self._widened = min(max(0.0, 0.5 * room), SPREAD * move.tube)
        """How far each is spread, m."""

    def _edgewise(self, least: float) -> tuple[float, float]:
        """Return how far the limb is turned about itself, rad, and how far its rings lie apart then across
        the way in, m: what is flat, such as a pair of legs, goes in edgewise if that gains so much (m).
        """
        over = turn_about(*self._over)
        flat, edge = (
            self._limb.reach(over @ turn_about(self._arm, spin), self._aside) for spin in (0.0, EDGEWISE)
        )
        return (EDGEWISE, edge) if edge < flat - least else (0.0, flat)

    def _ways(self, into: Floats, move: moves.Tuck) -> tuple[tuple[Floats, float], float]:
        """Return the turn of a limb to a place above both others, as an axis and an angle (rad), and by how
        much it has been turned too far about their common direction then, rad.

        `into`: from its joint to the place between both, (3,), m.
        """
        aside, arm = self._aside, self._arm
        deep = float(np.linalg.norm(_across(into, aside)))
        if move.point is not None:
            into = np.array(move.point)
        elif deep < BESIDE * move.tube:
            # Both are beside its joint: it comes in where it hangs.
            into = arm
        into = unit(_across(into, aside))
        above = 0.5 * ROOM * (move.width + move.tube)
        too_far = math.asin(min(1.0, above / max(deep, 1e-9)))
        if float(arm @ np.cross(aside, into)) < 0.0:
            too_far = -too_far
        return turn_between(arm, turn_about(aside, too_far) @ into), too_far

    def advance(self, share: float) -> None:
        """Spread both, lead the limb over them and in, and let them close."""
        apart = smooth(share / OVER) * (1.0 - smooth((share - IN) / (1.0 - IN)))
        (axis, angle), gone = self._over, smooth(share / OVER)
        over = turn_about(axis, gone * angle) @ turn_about(self._arm, gone * self._spin)
        into = self._in + math.copysign(BEYOND, self._in)
        self._limb.turn(turn_about(self._aside, -into * smooth((share - OVER) / (IN - OVER))) @ over)
        shifts = []
        for sign, joints, began in zip((-1.0, 1.0), self._spread, self._began, strict=True):
            shift = np.broadcast_to(sign * apart * self._widened * self._aside, began.shape)
            self._hands.goal[joints] = began + shift
            shifts.append(shift)
        self._hands.goal[self._carried.joints] = self._carried.goals(np.concatenate(shifts))


def _across(way: Floats, axis: Floats) -> Floats:
    """Return the part of a way (3,) that is across a unit axis (3,)."""
    across: Floats = way - axis * float(way @ axis)
    return across


def _sides(piece: Workpiece, move: moves.Tuck, sculpture: LatexSculpture) -> list[tuple[int, ...]]:
    """Return the rings of the plan by which each of two bubbles is spread, or each half of a loop."""
    table = sculpture.plan.table
    if len(move.between) == 1:
        guides = table.guides(move.between[0])
        half = len(guides) // 2
        return [guides[:half], guides[-half:]]
    found = [(*table.guides(name), *_free_end(piece, name, move.bubble, sculpture)) for name in move.between]
    # Very short ones have no ring but at their ends.
    return [rings or table.along(name) for rings, name in zip(found, move.between, strict=True)]


def _free_end(piece: Workpiece, name: str, limb: str, sculpture: LatexSculpture) -> tuple[int, ...]:
    """Return the ring of the end of a bubble that comes along with it, away from a limb: none of one that is
    a side of a ring, and none of a tip.
    """
    if name not in piece.bridges():
        return ()
    outer = [end for end in ends_of(name) if limb not in piece.hangs_on(end)]
    rings = [sculpture.plan.table.joint(end) for end in outer]
    return tuple(ring for ring in rings if ring is not None)
