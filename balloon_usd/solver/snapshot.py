"""Snapshots: a frame of many plans as flat arrays, and the changes since the frame before."""

from __future__ import annotations

from contextlib import closing
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.frame import Frame

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from balloon_usd.solver.frame_arrays import FrameArrays, Place

    Memory = Callable[[], FrameArrays]
    """Returns the arrays into which the next snapshot is written."""

Outcome = Frame | SimulationFailed | None
"""What a frame brings for a plan: the frame, its failure, or nothing as it is over."""


class Change(NamedTuple):
    """Change of the status of one plan."""

    plan: int
    doing: str
    """What the hands do."""
    undone: tuple[str, ...]
    """Locks that have slipped and joints that have come undone so far."""
    failed: SimulationFailed | None = None
    """Why there is nothing more of this plan."""


@dataclass(frozen=True)
class Snapshot:
    """All plans at one time."""

    time_code: int
    """Number of the frame, from 1."""
    arrays: FrameArrays
    """The arrays of all plans, one after another; undefined for plans that are over."""
    made: NDArray[np.bool_]
    """Whether every plan has this frame, (plans,): it is neither over nor failed."""
    changes: Sequence[Change]
    """Of the plans whose status has changed; of all in the first snapshot."""


def frames_of(snapshots: Generator[Snapshot], places: Sequence[Place]) -> Iterator[list[Outcome]]:
    """Yield what every snapshot brings for each plan, whose arrays lie at these places."""
    doing = [""] * len(places)
    undone: list[tuple[str, ...]] = [()] * len(places)
    with closing(snapshots):
        for shot in snapshots:
            failed = {change.plan: change.failed for change in shot.changes}
            for change in shot.changes:
                doing[change.plan], undone[change.plan] = change.doing, change.undone
            yield [
                shot.arrays.frame(place, shot.time_code, doing[k], undone[k]) if made else failed.get(k)
                for k, (place, made) in enumerate(zip(places, shot.made.tolist(), strict=True))
            ]
