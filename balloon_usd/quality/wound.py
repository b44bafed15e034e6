"""Bubbles that were wound round each other, or rolled up: do they stay so?"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.language.choices import all_of
from balloon_usd.language.joint import ends_of
from balloon_usd.operations.moves import Curl, WindRound
from balloon_usd.quality.joints import SLIPPED
from balloon_usd.quality.measures import MEASURES
from balloon_usd.quality.ring_corners import RingCorners

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.operations.moves import Move
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]

SHARES = np.linspace(0.1, 0.9, 33)
"""Places along a strand at which its turns are counted: at its ends all strands are one."""


class WoundBubbles:
    """Takes the frames of one sculpture; counts the turns of each spiral and of each coil.

    Left out is what is popped later, and what hangs in a joint that comes undone.
    """

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh]) -> None:
        """Find out what to look at; one mesh a balloon, in the order of `Plan.strips`."""
        self._fps = plan.recipe.fps
        # What is wound once more has all its turns in the last move.
        last: dict[frozenset[str], _Wound] = {}
        for move in plan.choreography.moves:
            wound = _wound(plan, meshes, move)
            if wound is not None and plan.recipe.piece.popped.isdisjoint(wound.bubbles):
                last[frozenset(wound.bubbles)] = wound
        self._wound = list(last.values())

    def add(self, frame: Frame) -> None:
        """Take the next frame."""
        undone = {name for told in frame.undone for name in told.split(SLIPPED)}
        for each in self._wound:
            each.add(frame, undone)

    def unwound(self) -> list[str]:
        """Return which bubbles have lost more than half of their turns, and since when."""
        limit = MEASURES["unwound"].limit
        return [
            f"{each.name} unwound to {each.turns:.1f} of {each.asked:g} turns at "
            f"{(each.since - 1) / self._fps:.1f} s"
            for each in self._wound
            if each.since is not None and each.lost > limit
        ]

    def result(self) -> dict[str, Any]:
        """Return the largest share of its turns that any has lost, once the last frame is taken."""
        measure = MEASURES["unwound"]
        kept = [each for each in self._wound if not each.open]
        if not kept:
            return measure.result(None)
        worst = max(kept, key=lambda each: each.lost)
        turns = {each.name: [round(each.turns, 3), each.asked] for each in kept}
        return measure.result(worst.lost, {"worst": worst.name, "turns": turns})


class _Wound(ABC):
    """What one move has wound."""

    def __init__(self, bubbles: tuple[str, ...], asked: float, since: int) -> None:
        """Begin with no turns.

        `bubbles`: that are wound; `asked`: turns that shall stay; `since`: time code from which on they are
        counted.
        """
        self._ends = {str(end) for name in bubbles for end in ends_of(name)}
        self._first = since
        self.bubbles, self.name, self.asked = bubbles, all_of(bubbles), asked
        self.turns = 0.0
        self.since: int | None = None
        """Time code since which more than half of its turns are lost."""
        self.open = False
        """Whether one of its joints has come undone."""

    @property
    def lost(self) -> float:
        """Share of its turns that it has lost."""
        return max(1.0 - self.turns / self.asked, 0.0)

    @abstractmethod
    def count(self, frame: Frame) -> float:
        """Return its turns in a frame, right-handed above 0."""

    def add(self, frame: Frame, undone: set[str]) -> None:
        """Take the next frame; `undone`: all joints that have come undone by then."""
        if frame.time_code < self._first:
            return
        self.open = self.open or not self._ends.isdisjoint(undone)
        self.turns = abs(self.count(frame))
        if self.open or self.lost <= MEASURES["unwound"].limit:
            self.since = None
        elif self.since is None:
            self.since = frame.time_code


class _Spiral(_Wound):
    """The strands of one spiral."""

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh], move: WindRound) -> None:
        super().__init__(move.bubbles, move.asked, _code_after(plan, move))
        self._strands = [[RingCorners.of(plan, meshes, ring) for ring in strand] for strand in move.strands]

    def count(self, frame: Frame) -> float:
        """Return how often its strands go round each other."""
        return turns_of([_middles(strand, frame) for strand in self._strands])


class _Coil(_Wound):
    """A bubble that is rolled up."""

    def __init__(self, plan: Plan, meshes: Sequence[BalloonMesh], move: Curl) -> None:
        bubble = plan.table.rings[move.rings[1]].bubble
        super().__init__((bubble,), move.asked, _code_after(plan, move))
        firm = move.rings[: len(move.rings) - move.flat]
        self._rings = [RingCorners.of(plan, meshes, ring) for ring in firm]

    def count(self, frame: Frame) -> float:
        """Return how often it goes round its axis."""
        return turns_of_coil(_middles(self._rings, frame))


def _wound(plan: Plan, meshes: Sequence[BalloonMesh], move: Move) -> _Wound | None:
    """Return what a move winds, None where it winds nothing."""
    if isinstance(move, WindRound):
        return _Spiral(plan, meshes, move)
    return _Coil(plan, meshes, move) if isinstance(move, Curl) else None


def _code_after(plan: Plan, move: Move) -> int:
    """Return the first time code after a move: the time of a frame is (code - 1) / fps."""
    return 1 + math.ceil(move.end * plan.recipe.fps)


def _middles(rings: Sequence[RingCorners], frame: Frame) -> Floats:
    """Return the middles of some rings in a frame, (N, 3), m."""
    return np.array([ring.places(frame).mean(axis=0) for ring in rings])


def turns_of_coil(middles: Floats) -> float:
    """Return how often the middle line of a tube goes round the axis of its coil from end to end, at least 0.

    `middles`: places along it, in order, (N, 3), m. Its axis is the one about which it turns on the whole.
    """
    ways = np.diff(middles, axis=0)
    ways /= np.maximum(np.linalg.norm(ways, axis=1), 1e-9)[:, None]
    axis = np.cross(ways[:-1], ways[1:]).sum(axis=0)
    axis /= max(float(np.linalg.norm(axis)), 1e-9)
    across = _across(ways, axis)
    angles = _turned(across[:-1], across[1:], axis)
    # Half a side at either end turns, too.
    return float(angles.sum() / math.tau * len(ways) / max(len(angles), 1))


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
    angles = _turned(before, behind, along)
    return float(angles.sum(axis=1).mean() / math.tau / (SHARES[-1] - SHARES[0]))


def _evenly(strand: Floats) -> Floats:
    """Return the places of a strand at `SHARES` of its length, (33, 3), m."""
    gone = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(strand, axis=0), axis=1))])
    at = SHARES * gone[-1]
    return np.stack([np.interp(at, gone, values) for values in strand.T], axis=1)


def _across(vectors: Floats, along: Floats) -> Floats:
    """Return what vectors (..., 3) have across unit directions, (..., 3)."""
    across: Floats = vectors - (vectors * along).sum(axis=-1, keepdims=True) * along
    return across


def _turned(before: Floats, behind: Floats, along: Floats) -> Floats:
    """Return by what angles vectors are turned about unit directions that they lie across, (...), rad."""
    sines = (np.cross(before, behind) * along).sum(axis=-1)
    return np.asarray(np.arctan2(sines, (before * behind).sum(axis=-1)))
