"""Bubbles that were wound round each other: do they stay so?"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.language.choices import all_of
from balloon_usd.language.joint import Joint
from balloon_usd.operations.moves import WindRound
from balloon_usd.quality.joints import SLIPPED
from balloon_usd.quality.measures import MEASURES
from balloon_usd.quality.ring_corners import RingCorners

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]

SHARES = np.linspace(0.1, 0.9, 33)
"""Places along a strand at which its turns are counted: at its ends all strands are one."""


class WoundSpirals:
    """Takes the frames of one sculpture; counts the turns of each spiral.

    Left out is what is popped later, and what hangs in a joint that comes undone.
    """

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh]) -> None:
        """Find out what to look at; one mesh a balloon, in the order of `Plan.strips`."""
        self._fps = plan.recipe.fps
        # What is wound once more has all its turns in the last move.
        last = {
            frozenset(move.bubbles): move
            for move in plan.choreography.moves
            if isinstance(move, WindRound) and plan.recipe.piece.popped.isdisjoint(move.bubbles)
        }
        self._spirals = [_Spiral(plan, meshes, move) for move in last.values()]

    def add(self, frame: Frame) -> None:
        """Take the next frame."""
        undone = {name for told in frame.undone for name in told.split(SLIPPED)}
        for each in self._spirals:
            each.add(frame, undone)

    def unwound(self) -> list[str]:
        """Return which bubbles have lost more than half of their turns, and since when."""
        limit = MEASURES["unwound"].limit
        return [
            f"{each.name} unwound to {each.turns:.1f} of {each.asked:g} turns at "
            f"{(each.since - 1) / self._fps:.1f} s"
            for each in self._spirals
            if each.since is not None and each.lost > limit
        ]

    def result(self) -> dict[str, Any]:
        """Return the largest share of its turns that a spiral has lost, once the last frame is taken."""
        measure = MEASURES["unwound"]
        kept = [each for each in self._spirals if not each.open]
        if not kept:
            return measure.result(None)
        worst = max(kept, key=lambda each: each.lost)
        turns = {each.name: [round(each.turns, 3), each.asked] for each in kept}
        return measure.result(worst.lost, {"worst": worst.name, "turns": turns})


class _Spiral:
    """The strands of one spiral."""

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh], move: WindRound) -> None:
        self._strands = [[RingCorners.of(plan, meshes, ring) for ring in strand] for strand in move.strands]
        self._ends = {str(Joint(name, end)) for name in move.bubbles for end in ("start", "end")}
        # The time of a frame is (code - 1) / fps.
        self._last = 1 + math.ceil(move.end * plan.recipe.fps)
        self.name = all_of(move.bubbles)
        self.asked = move.asked
        self.turns = 0.0
        self.since: int | None = None
        """Time code since which more than half of its turns are lost."""
        self.open = False
        """Whether one of its joints has come undone."""

    @property
    def lost(self) -> float:
        """Share of its turns that it has lost."""
        return max(1.0 - self.turns / self.asked, 0.0)

    def add(self, frame: Frame, undone: set[str]) -> None:
        """Take the next frame; `undone`: all joints that have come undone by then."""
        if frame.time_code < self._last:
            return
        self.open = self.open or not self._ends.isdisjoint(undone)
        rows = [np.array([each.places(frame).mean(axis=0) for each in strand]) for strand in self._strands]
        self.turns = abs(turns_of(rows))
        if self.open or self.lost <= MEASURES["unwound"].limit:
            self.since = None
        elif self.since is None:
            self.since = frame.time_code


def turns_of(strands: Sequence[Floats]) -> float:
    """Return how often some strands go round each other from end to end, right-handed above 0.

    `strands`: places along the middle of each, in order, from the same end on; (N, 3) each, m.
    """
    rows = np.array([_evenly(strand) for strand in strands])
    middle = rows.mean(axis=0)
    along = np.diff(middle, axis=0)
    along /= np.maximum(np.linalg.norm(along, axis=1), 1e-9)[:, None]
    beside = rows - middle
    before, behind = (_across(each, along) for each in (beside[:, :-1], beside[:, 1:]))
    sines = (np.cross(before, behind) * along).sum(axis=2)
    angles = np.arctan2(sines, (before * behind).sum(axis=2))
    return float(angles.sum(axis=1).mean() / math.tau / (SHARES[-1] - SHARES[0]))


def _evenly(strand: Floats) -> Floats:
    """Return the places of a strand at `SHARES` of its length, (33, 3), m."""
    gone = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(strand, axis=0), axis=1))])
    at = SHARES * gone[-1]
    return np.stack([np.interp(at, gone, values) for values in strand.T], axis=1)


def _across(vectors: Floats, along: Floats) -> Floats:
    """Return what vectors (S, N, 3) have across unit directions, (N, 3)."""
    across: Floats = vectors - (vectors * along).sum(axis=2, keepdims=True) * along
    return across
