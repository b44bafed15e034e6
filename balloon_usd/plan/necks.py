"""Necks of a capsule: how much of its wall a bubble takes.

Towards a neck the wall curves in instead of running straight on, so that a bubble takes more wall than it is
long.
"""

from __future__ import annotations

NECK_EXCESS = 0.22
"""Wall that a neck takes beyond the bubble's length, in radii of the bubble's round end: a quarter circle
would take 0.57, but the air stretches it.
"""


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
    together; the wall that a neck takes lies evenly along its round end.
    """
    end = _round_end(length, radius)
    before, after = (
        NECK_EXCESS * min(away, end) if drawn else 0.0
        for away, drawn in zip((at, length - at), necks, strict=True)
    )
    taken = NECK_EXCESS * end if necks[1] else 0.0
    return at + before + taken - after


def _round_end(length: float, radius: float) -> float:
    """Radius (m) of a bubble's round ends."""
    return min(radius, 0.5 * length)
