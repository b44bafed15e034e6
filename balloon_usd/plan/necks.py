"""Necks of a capsule: how much of its wall a bubble takes, when drawing rings together stretches no wall.

Towards a neck the wall follows a quarter circle instead of running straight on, so that a bubble takes more
wall than it is long.
"""

from __future__ import annotations

import math

NECK_EXCESS = 0.5 * math.pi - 1.0
"""Wall that a neck takes beyond the bubble's length, in radii of the bubble's round end."""


def wall_length(length: float, radius: float, necks: int) -> float:
    """Return the length (m) of wall that a bubble of a length (m) takes from a tube of a radius (m).

    `necks`: how many of its ends are drawn together.
    """
    return length + necks * NECK_EXCESS * _round_end(length, radius)


def bubble_length(wall: float, radius: float, necks: int) -> float:
    """Return the length (m) of the bubble that takes so much wall (m) from a tube of a radius (m)."""
    return max(wall - necks * NECK_EXCESS * radius, wall / (1.0 + 0.5 * necks * NECK_EXCESS))


def wall_place(at: float, length: float, radius: float, necks: tuple[bool, bool]) -> float:
    """Return how much wall (m) lies between a bubble's start and a place at some distance (m) from it.

    `length`, `radius`: of the bubble and of its tube, m. `necks`: whether its start and its end are drawn
    together.
    """
    end = _round_end(length, radius)
    if at <= 0.5 * length:
        return _wall_beside(at, end) if necks[0] else at
    beyond = length - at
    return wall_length(length, radius, sum(necks)) - (_wall_beside(beyond, end) if necks[1] else beyond)


def _round_end(length: float, radius: float) -> float:
    """Radius (m) of a bubble's round ends."""
    return min(radius, 0.5 * length)


def _wall_beside(away: float, end: float) -> float:
    """Wall (m) from a neck to a place this far (m) along the bubble, whose round end has a radius (m)."""
    if away >= end:
        return away + NECK_EXCESS * end
    return end * math.acos(1.0 - away / end)
