"""Bringing two balloons of latex into one line, knot to knot."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.latex.led_limb import hold_figure
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import turn_about, turn_between, unit

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]

TURNED = 0.6
"""Share of the time in which what was led in is turned, while its knot stays where it is."""


class FaceKnot(Motion):
    """A balloon that is turned about its knot, away from another, and brought before the knot of that."""

    def __init__(self, move: moves.FaceKnot, sculpture: LatexSculpture) -> None:
        """Take hold of all, and find how far what was led in is to be turned."""
        hold_figure(sculpture)
        self._hands = sculpture.hands
        middle = sculpture.frame.middle.astype(np.float64)
        knot, end = sculpture.joints[move.knot], sculpture.joints[move.other]
        inward = unit(middle[sculpture.joints[move.neck]] - middle[knot])
        """Unit direction from the one knot through its bubble."""
        outward = unit(middle[first_rings(sculpture, move.other)].mean(axis=0) - middle[end])
        """The same of the other one."""
        gap = 2.0 * float(self._hands.neck[knot])
        led, held = (end, knot) if move.moved == move.other else (knot, end)
        self._joints = rings_with(sculpture, move.moved)
        self._base: Floats = middle[led]
        self._began = middle[self._joints] - self._base
        arm, other = (outward, inward) if led == end else (inward, outward)
        aside = self._base - middle[held]
        aside = unit(aside - other * float(aside @ other))
        # By way of where it lies: else it would go through the other one.
        self._first, self._second = turn_between(arm, aside), turn_between(aside, -other)
        self._way: Floats = middle[held] - gap * other - self._base

    def advance(self, share: float) -> None:
        """Turn it a share of its turn, and bring it on."""
        turned = smooth(share / TURNED)
        (one, first), (other, second) = self._first, self._second
        turn = turn_about(other, turned * second) @ turn_about(one, turned * first)
        way = smooth((share - 0.5 * TURNED) / (1.0 - 0.5 * TURNED)) * self._way
        self._hands.goal[self._joints] = self._base + way + self._began @ turn.T


def rings_with(sculpture: LatexSculpture, ring: int) -> NDArray[np.int64]:
    """Return the joints of the scene of all rings that hang on one of the plan, and its own."""
    rings = {ring, *sculpture.rings_hanging_on((ring,))[0]}
    return np.array(sorted(sculpture.joints[each] for each in rings), dtype=np.int64)


def first_rings(sculpture: LatexSculpture, knot: int) -> list[int]:
    """Return the joints of the scene of the rings of the first bubble of a balloon, but for its knot."""
    table = sculpture.plan.table
    return [sculpture.joints[ring] for ring in table.along(table.rings[knot].bubble) if ring != knot]
