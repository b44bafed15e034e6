"""The air that a hand pump brings, stroke by stroke."""

from __future__ import annotations

from balloon_usd.operations.moves import PUSHING

RAMP = 0.3
"""Share of a push in which its flow grows, and falls."""
MOST_FLOW = 1.2 / (PUSHING * (1.0 - RAMP))
"""Largest flow, in the mean of all the time: a balloon that gave way late is not blown up at once then."""


def brought(share: float, strokes: int) -> float:
    """Return the share of its air that a pump has brought after a share of its time, in equal strokes."""
    done, begun = divmod(share * strokes, 1.0)
    return min((done + _pushed(min(begun / PUSHING, 1.0))) / strokes, 1.0)


def _pushed(share: float) -> float:
    """Return what has come of a push: its flow grows evenly, stays, and falls evenly."""
    if share > 0.5:
        return 1.0 - _pushed(1.0 - share)
    grown = min(share, RAMP)
    return (0.5 * grown**2 / RAMP + share - grown) / (1.0 - RAMP)
