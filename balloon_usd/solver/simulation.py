"""Simulations: plans in, frames out, many sculptures in one flat state.

Concurrency: on a CPU each thread advances flat states of its own, and holds the capture lock except while a
graph runs; where there are fewer plans than cores, a team of threads advances each state. On a GPU the next
frame is computed while the host checks the last one and gives it out; from `MANY` sculptures on there are two
flat states, of which the GPU steps one while the host processes the other.
"""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module
from itertools import pairwise
from typing import TYPE_CHECKING, TypeVar, cast

import warp as wp

from balloon_usd.balloon.detail import Detail, detail_named
from balloon_usd.plan.meshing import made_meshes, shown_meshes
from balloon_usd.processes.cores import usable_cores
from balloon_usd.solver.batch import Batch, snapshots_of
from balloon_usd.solver.device import device_named
from balloon_usd.solver.frame_arrays import Extent
from balloon_usd.solver.snapshot import frames_of

if TYPE_CHECKING:
    from collections.abc import Generator, Iterable, Iterator, Sequence

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame_arrays import Place
    from balloon_usd.solver.model import Model, ModelMaker
    from balloon_usd.solver.snapshot import Memory, Outcome, Snapshot

T = TypeVar("T")

NOMINAL_RATE = 24.0
"""Frame rate for which substeps are given, 1/s."""

THREADED = frozenset({"latex"})
"""Models whose sculptures run in threads on a CPU. Kernels with tiles must not: Warp 1.19 has one memory for
them, which all threads of a process share.
"""
STATES_PER_THREAD = 4
"""Most flat states for each thread on a CPU: enough that all end at about the same time, few enough that what
each needs besides its sculptures does not add up.
"""

MODELS = {"latex": "LatexModel", "kosaka": "KosakaModel"}
"""Physical models by the names that recipes give them."""
MANY = 192
"""Sculptures from which on half of them fill a GPU."""


class Simulation:
    """Plans performed together, one frame at a time."""

    def __init__(
        self, plans: Iterable[Plan], detail: Detail, device: str, threads: int | None = None
    ) -> None:
        """Prepare to perform plans; `threads`: of a CPU at most, one for each of its cores if absent."""
        self.plans = tuple(plans)
        self.detail = detail
        self.device = device
        self.fps = _the_one("frame rate", [plan.recipe.fps for plan in self.plans])
        model = _the_one("model", [plan.recipe.physics.model for plan in self.plans])
        maker = model_named(model)
        self.substeps = _substeps(self.plans, maker.usual_substeps(detail), self.fps)
        made = [made_meshes(plan, detail) for plan in self.plans]
        self.meshes: list[tuple[BalloonMesh, ...]] = [
            shown_meshes(*each) for each in zip(self.plans, made, strict=True)
        ]
        """As frames show them; hands may have their mirror images."""
        on_gpu = wp.get_device(device).is_cuda
        cores = 1 if on_gpu or model not in THREADED else threads or usable_cores()
        self._threads = min(cores, len(self.plans))
        self._batches = [
            Batch(
                maker,
                self.plans[run.start : run.stop],
                made[run.start : run.stop],
                self.frame_counts[run.start : run.stop],
                self.substeps,
                device,
                # On a CPU it would only make the first frame come later.
                ahead=on_gpu,
                threads=cores // self._threads,
            )
            for run in _runs(len(self.plans), self._states(model, on_gpu=on_gpu))
        ]

    def _states(self, model: str, *, on_gpu: bool) -> int:
        """Return among how many flat states the plans are shared out."""
        count = len(self.plans)
        if model not in THREADED:
            return 1
        if on_gpu:
            # Double buffering: the GPU steps one half while the host processes the other.
            return 2 if count >= MANY else 1
        return 1 if self._threads == 1 else min(count, STATES_PER_THREAD * self._threads)

    @property
    def model(self) -> Model:
        """The model of the first plan; where one flat state holds all plans, that of all."""
        return self._batches[0].model

    @property
    def frame_counts(self) -> tuple[int, ...]:
        """Number of frames of every plan; the first shows the balloons before anything is done."""
        return tuple(plan.frame_count for plan in self.plans)

    def frames(self) -> Iterator[list[Outcome]]:
        """Return an iterator of the next frame of every plan until all are finished.

        A plan that has failed yields its `SimulationFailed` once; a plan that is over yields None.
        """
        return frames_of(self.snapshots(), self.places)

    @property
    def extent(self) -> Extent:
        """How many vertices, bubbles and particles all plans have together."""
        return Extent.of([batch.model.layout.extent for batch in self._batches])

    @property
    def places(self) -> list[Place]:
        """Where every plan lies in the arrays of a snapshot."""
        found: list[Place] = []
        before = self._batches[0].model.layout.extent.nothing
        for layout in (batch.model.layout for batch in self._batches):
            found += [place.after(before) for place in layout.places]
            before = Extent.of([before, layout.extent])
        return found

    def snapshots(self, memory: Memory | None = None) -> Generator[Snapshot]:
        """Yield flat arrays of all plans, frame by frame, until all are finished, and what has changed.

        Args:
            memory: gives the arrays, made by `extent.frame_arrays`, into which the next snapshot is written;
                new ones if it is absent. It may block until their readers are done.
        """
        memory = memory or self.extent.frame_arrays
        with ThreadPoolExecutor(self._threads) as threads:
            ask = map if self._threads == 1 else threads.map
            yield from snapshots_of(self._batches, memory, ask)


def model_named(name: str) -> ModelMaker:
    """Return the model of a name; importing another with its kernels would only take time."""
    return cast("ModelMaker", getattr(import_module(f"balloon_usd.solver.{name}.model"), MODELS[name]))


def _the_one(what: str, values: Sequence[T]) -> T:
    """Return what all plans have in common."""
    if len(set(values)) != 1:
        raise ValueError(
            f"sculptures that advance together need one {what}, got {sorted(map(str, set(values)))}"
        )
    return values[0]


def _runs(count: int, states: int) -> list[range]:
    """Share out so many plans among so many flat states."""
    bounds = [count * k // states for k in range(states + 1)]
    return [range(a, b) for a, b in pairwise(bounds)]


def _substeps(plans: Sequence[Plan], usual: int, fps: float) -> int:
    wanted = [plan.recipe.physics.substeps or math.ceil(usual * NOMINAL_RATE / fps) for plan in plans]
    return max(wanted) + max(wanted) % 2


def simulate_many(
    plans: Iterable[Plan], detail: str = "draft", device: str = "auto", threads: int | None = None
) -> Simulation:
    """Return a simulation of several plans that advance together.

    `threads`: of a CPU at most, one for each of its cores if absent; they change no bit.

    Raises:
        DeviceUnavailable: there is no such device.
        ValueError: the plans have different frame rates or models, there is no such level of detail, or no
            such number of threads.
    """
    if threads is not None and threads < 1:
        raise ValueError(f"{threads} threads, expected at least 1")
    return Simulation(plans, detail_named(detail), device_named(device), threads)
