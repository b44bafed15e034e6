"""Frames as bytes, to compare."""

from __future__ import annotations

from balloon_usd.solver.frame import Frame
from balloon_usd.solver.snapshot import Outcome


def bits(outcome: Outcome) -> object:
    """All that a plan was given in a frame."""
    if not isinstance(outcome, Frame):
        return str(outcome)
    contact = [] if outcome.contact is None else [outcome.contact]
    arrays = (*outcome.points, *outcome.stretch, outcome.pressure, outcome.volume, *contact, *outcome.air)
    numbers = [array.tobytes() for array in (*arrays, *outcome.cluster)]
    return outcome.time_code, outcome.doing, outcome.undone, numbers
