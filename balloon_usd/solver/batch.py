"""Batches: sculptures in one flat state, advanced, checked and given out one frame at a time."""

from __future__ import annotations

from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.capture_lock import capture_lock
from balloon_usd.solver.checks import BatchCheck
from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.frame_arrays import Extent
from balloon_usd.solver.snapshot import Change, Snapshot

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterable, Mapping, Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame_arrays import FrameArrays
    from balloon_usd.solver.model import Model, ModelMaker
    from balloon_usd.solver.placement import Placed
    from balloon_usd.solver.severed import Severed
    from balloon_usd.solver.snapshot import Memory
    from balloon_usd.solver.status import Status


class Batch:
    """Some plans performed together in one flat state."""

    def __init__(
        self,
        model: ModelMaker,
        plans: Sequence[Plan],
        meshes: Sequence[tuple[BalloonMesh, ...]],
        frame_counts: Sequence[int],
        substeps: int,
        device: str,
        *,
        ahead: bool,
        threads: int,
    ) -> None:
        """Put plans of so many frames each into a state.

        `ahead`: make the next frame while one is checked and given out; `threads`: of a CPU that may advance
        the state together.
        """
        self._fps = plans[0].recipe.fps
        self._counts = np.array(frame_counts)
        self._failed = np.zeros(len(plans), dtype=bool)
        """Plans that have failed."""
        self._ahead = ahead
        with capture_lock():
            self.model: Model = model(plans, meshes, self._fps, substeps, device, threads)
        self._checks = BatchCheck(plans, meshes, self.model.layout.places, self._fps, substeps)
        self._mirrored = [world for world, plan in enumerate(plans) if plan.mirrored]
        """Plans whose frames show the mirror image of what hands make."""
        self._statuses: Sequence[Status | None] = [None] * len(plans)
        """Latest status of every plan."""

    def __len__(self) -> int:
        """Return the number of plans."""
        return len(self._counts)

    def rest(self) -> None:
        """Wait until nothing is under way."""
        self.model.rest()

    def goes_on(self, index: int) -> bool:
        """Tell whether any plan has the frame of an index."""
        return bool(self._made(index).any())

    def snapshot(self, index: int, into: FrameArrays) -> Snapshot:
        """Return the frame of an index, written into arrays; the performers and the physics of the next have
        begun then.
        """
        with capture_lock():
            if index and not self._ahead:
                self._advance(index)
            self.model.read_back()
            arrays, statuses, suspects = self.model.frame_arrays, self.model.statuses, self.model.suspects
            causes, placements = self.model.failures(), self.model.placements
            severed = self.model.severed
            # A plan that fails in this frame still takes part in the next one, unseen.
            if self._ahead and self.goes_on(index + 1):
                self._advance(index + 1)
            arrays.copy_to(into)
            for world in self._checks.suspicious(arrays, suspects):
                if self._made(index)[world] and (cause := self._checks.failure(world)):
                    causes[world] = cause
            self._show(into, severed, placements)
            changes = self._changes(index, statuses, causes)
        return Snapshot(index + 1, into, self._made(index), changes)

    def _show(
        self,
        into: FrameArrays,
        severed: Mapping[int, Sequence[Severed]],
        placements: Mapping[int, Placed],
    ) -> None:
        """Turn what was simulated into what frames show: without what was cut off, where it is put, and not
        mirrored.
        """
        places = self.model.layout.places
        for world, cut in severed.items():
            for each in cut:
                each.stub.put(into.points[places[world].walls[each.balloon]])
        for world, placed in placements.items():
            placed.put(into.places_of(places[world]))
        for world in self._mirrored:
            for points in into.places_of(places[world]):
                points[:, 1] *= -1.0

    def _advance(self, index: int) -> None:
        """Begin the frame of an index of the plans that have one."""
        over = ~self._made(index)
        if (over != self.model.over).any():
            self.model.leave(over)
        self.model.advance((index - 1) / self._fps, index / self._fps)

    def _made(self, index: int) -> NDArray[np.bool_]:
        """Return which plans have the frame of an index, (plans,)."""
        return (index < self._counts) & ~self._failed

    def _changes(self, index: int, statuses: Sequence[Status], causes: dict[int, str]) -> list[Change]:
        """Return the changes since the last frame, and note the plans that have failed."""
        made = self._made(index)
        before, self._statuses = self._statuses, statuses
        fresh = {k: Change(k, *now) for k, now in enumerate(statuses) if now != before[k] and made[k]}
        for world, cause in causes.items():
            if made[world]:
                self._failed[world] = True
                failed = SimulationFailed(statuses[world].doing, index / self._fps, cause, index + 1)
                fresh[world] = Change(world, *statuses[world], failed)
        return [fresh[world] for world in sorted(fresh)]


def snapshots_of(
    batches: Sequence[Batch],
    memory: Memory,
    ask: Callable[..., Iterable[Snapshot]] = map,
) -> Generator[Snapshot]:
    """Yield all plans of some batches together, frame by frame, until all are finished or have failed.

    `memory`: gives the arrays of all into which each is written; `ask`: as `map`.
    """
    extents = [batch.model.layout.extent for batch in batches]
    befores = list(accumulate(extents, lambda *both: Extent.of(both), initial=extents[0].nothing))[:-1]
    index = 0
    try:
        while any(batch.goes_on(index) for batch in batches):
            whole = memory()
            parts = [whole.part(*span) for span in zip(befores, extents, strict=True)]
            shots = list(ask(_next, batches, parts, [index] * len(parts)))
            yield shots[0] if len(batches) == 1 else _together(index, whole, shots)
            index += 1
    finally:
        # Pending work ends before its arrays are freed.
        for batch in batches:
            batch.rest()


def _next(batch: Batch, part: FrameArrays, index: int) -> Snapshot:
    """Return the next snapshot of a batch; nothing is done for one whose plans are all over."""
    if batch.goes_on(index):
        return batch.snapshot(index, part)
    return Snapshot(index + 1, part, np.zeros(len(batch), dtype=bool), [])


def _together(index: int, whole: FrameArrays, shots: Sequence[Snapshot]) -> Snapshot:
    """Return the snapshots of batches as one."""
    first = accumulate([len(shot.made) for shot in shots[:-1]], initial=0)
    changes = [
        change._replace(plan=before + change.plan)
        for before, shot in zip(first, shots, strict=True)
        for change in shot.changes
    ]
    return Snapshot(index + 1, whole, np.concatenate([shot.made for shot in shots]), changes)
