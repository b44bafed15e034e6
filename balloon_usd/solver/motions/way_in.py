"""The way on which a balloon comes in from where it lay, clear of all else that is there."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.placement import turn_about, turn_between, unit
from balloon_usd.solver.sculpture import ALONG

Floats = NDArray[np.float64]

BESIDE = 0.12
"""How far beside the held ring the way ends, m: from there the joint is brought to it."""
CLEAR = 0.08
"""Distance of the middles of two tubes that pass each other, m."""
LIFTS = (0.0, 0.25, -0.25)
"""Heights over which the way may lead, m."""
SIDES = tuple(math.radians(angle) for angle in (0.0, 40.0, -40.0, 80.0, -80.0))
"""Angles about the balloon, from the side on which it lay, at which it may come to lie, rad."""
ALL_SIDES = tuple(math.radians(angle) for angle in range(0, 360, 30))
"""The same where it shall lie to a certain side, rad."""
TILT = math.radians(20.0)
"""Angle by which a balloon is turned on its way, rad: its joint comes first, what hangs on it stays off."""
MORE_TILTS = tuple(math.radians(angle) for angle in (50.0, 90.0))
"""Angles by which one may be turned of which nothing more is made, rad."""
NEAR = 0.1
"""Distance from a joint within which bubbles that meet there touch, m."""
LOOKED_AT = np.array([0.2, 0.4, 0.6, 0.8, 0.9, 1.0])
"""Shares of the way at which it is looked at."""


@dataclass(frozen=True)
class WayIn:
    """A way of a ring, and the turn of all that goes with it."""

    begin: Floats
    """Where the ring is, (3,), m."""
    end: Floats
    """Where it comes to, (3,), m."""
    lift: float
    """How far it is raised half way, m."""
    axis: Floats
    """Unit axis of the turn, (3,)."""
    angle: float
    """By how much all is turned in the end, rad."""

    def place(self, progress: float) -> Floats:
        """Return where the ring is at a progress of 0 to 1, (3,), m."""
        raised = 4.0 * progress * (1.0 - progress) * self.lift
        return np.asarray(self.begin + progress * (self.end - self.begin) + np.array([0.0, 0.0, raised]))

    def pose(self, progress: float, points: Floats) -> Floats:
        """Return where points (N, 3) that go with the ring are at a progress of 0 to 1, (N, 3), m."""
        turn = turn_about(self.axis, progress * self.angle)
        return np.asarray(self.place(progress) + (points - self.begin) @ turn.T)

    def clearance(self, coming: Floats, others: Floats, held: Floats | None) -> float:
        """Return the smallest distance of points that come, (N, 3), from others, (M, 3), on the way, and when
        the ring is at the held one, (3,), if that counts, m.
        """
        places = np.concatenate([self.pose(progress, coming) for progress in LOOKED_AT])
        if held is not None:
            joined = self.pose(1.0, coming) + held - self.end
            far = np.linalg.norm(joined - held, axis=1) > NEAR
            places = np.concatenate([places, joined[far]])
        return _apart(places, others)


def way_in(
    begin: Floats, held: Floats, coming: Floats, others: Floats, toward: Floats | None, *, done: bool = False
) -> WayIn:
    """Return the way of a ring to a place beside another: the first that is clear, or the clearest.

    Args:
        begin: where the ring is, (3,), m.
        held: where the other is, (3,), m.
        coming: points of all that goes with the ring, (N, 3), m.
        others: points of all else, (M, 3), m.
        toward: direction from the held ring in which what comes shall lie, (3,); None for any.
        done: whether nothing more is made of what comes; the rest of a balloon that is worked on must lie
            along x.
    """
    side = unit((begin - held) * (1.0 - ALONG))
    tilts = (TILT, *MORE_TILTS) if done else (TILT,)
    sides = [turn_about(ALONG, angle) @ side for angle in SIDES]
    if toward is not None:
        sides = [turn_about(ALONG, angle) @ side for angle in ALL_SIDES]
        sides.sort(key=lambda each: -float(each @ toward))
    ways = (_way(begin, held, coming, side, lift, tilt) for tilt, side, lift in product(tilts, sides, LIFTS))
    best, most = None, -1.0
    for way in ways:
        clear = way.clearance(coming, others, held if done else None)
        if clear >= CLEAR:
            return way
        if clear > most:
            best, most = way, clear
    assert best is not None, "there is a way"
    return best


def _way(begin: Floats, held: Floats, coming: Floats, side: Floats, lift: float, tilt: float) -> WayIn:
    """Return the way to a place on a side (3,) of a ring, to which what hangs on the joint is turned, unless
    it hangs there on both sides.
    """
    hanging = unit(coming.mean(axis=0) - begin)
    axis, angle = turn_between(hanging, side)
    if float(((coming - begin) @ hanging).min()) < -NEAR:
        angle = 0.0
    return WayIn(begin, held + BESIDE * side, lift, axis, min(angle, tilt))


def _apart(points: Floats, others: Floats) -> float:
    """Return the smallest distance between points (N, 3) and others (M, 3), m."""
    square = (points**2).sum(axis=1)[:, None] + (others**2).sum(axis=1) - 2.0 * points @ others.T
    return math.sqrt(max(float(square.min()), 0.0))
