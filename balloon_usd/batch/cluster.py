"""Batches on a Ray cluster: surveyed here, made in chunks by the engine of each machine."""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from balloon_usd.batch.engine import Engine, run_batch
from balloon_usd.batch.machine import Machine
from balloon_usd.batch.ray_cluster import import_ray, require_ray_at
from balloon_usd.batch.ray_engine import make_on_cluster
from balloon_usd.batch.ray_machines import Needs
from balloon_usd.batch.record import Record, Status, made_of, options_of, record_of
from balloon_usd.batch.watch import Count, Silence
from balloon_usd.processes.cores import usable_cores

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.batch.job import Job
    from balloon_usd.batch.journal import Journal
    from balloon_usd.batch.order import Order
    from balloon_usd.batch.ray_engine import Ended
    from balloon_usd.batch.watch import Watch

CHUNK_ON_CPU = 4
"""Recipes of a task without a GPU: few, so that little is lost with a machine."""
CHUNK_ON_GPU = 256
"""Recipes of a task with a GPU, which is idle with few."""
CHUNKS_PER_MACHINE = 4
"""Tasks for each machine, if there are recipes enough, so that all end at about the same time."""


def run_on_cluster(
    recipes: Sequence[Path], order: Order, machine: Machine, address: str | None, watch: Watch | None = None
) -> list[Record]:
    """Make the stages of recipes on a Ray cluster; see `run_batch`.

    Args:
        recipes: that all machines see under the same paths.
        order: its folder is shared by all machines.
        machine: what one task uses: its devices, and so many cores; none of its own in this process.
        address: HOST:PORT of the cluster; None starts one on this machine.
        watch: is told of recipes as their chunks end.

    Raises:
        ClusterError: the cluster cannot be used; one line a problem.
        BatchError: as `run_batch`.
    """
    import_ray()
    if address is not None:
        require_ray_at(address)
    shared = replace(order, folder=order.folder.absolute())
    with _ClusterEngine(shared, machine, watch or Silence(), address) as engine:
        return engine.make([str(recipe) for recipe in recipes])


class _ClusterEngine(Engine):
    """Surveys recipes here, and lets a cluster make them."""

    def __init__(self, order: Order, machine: Machine, watch: Watch, address: str | None) -> None:
        super().__init__(order, replace(machine, cores=usable_cores()), watch)
        self._address = address
        self._cores = machine.cores

    def start_workers(self, recipes: int) -> None:
        """Start writers alone: they answer questions about recipes and files."""
        self.start_writers(recipes)

    def make_all(self, jobs: Sequence[Job], journal: Journal) -> None:
        """Make jobs in chunks, one task each."""
        by_path = {str(Path(job.file).absolute()): job for job in jobs}
        chunks = _chunks(jobs, CHUNK_ON_CPU if self._needs() == Needs(self._cores) else CHUNK_ON_GPU)
        self.watch.begun(f"Ray {self._address or 'on this machine'}", sum(job.known.frames for job in jobs))
        done = failed = 0
        make = _Make(self.order, self.machine.devices)
        for ended in make_on_cluster(chunks, make, self._needs(), self.order.folder, self._address):
            for job, record in _records(ended, by_path, self.order):
                job.record = replace(record, recipe=job.file)
                journal.add(job.record)
                self.watch.ended(job.record)
                made = record.status in {Status.DONE, Status.SKIPPED}
                done, failed = done + made, failed + (not made)
                count = Count(len(jobs), len(jobs) - done - failed, done, failed)
                self.watch.advanced("on the cluster", job.known.frames, count)

    def _needs(self) -> Needs | None:
        """What a task takes: None leaves the choice to the cluster."""
        if self.machine.devices == ("cpu",):
            return Needs(self._cores)
        return None if self.machine.may_fall_back else Needs(self._cores, 1)


@dataclass(frozen=True)
class _Make:
    """Makes a chunk on the machine where it is called."""

    order: Order
    devices: tuple[str, ...]

    def __call__(self, chunk: Sequence[str]) -> list[dict[str, Any]]:
        """Return a record of each recipe."""
        import ray  # noqa: PLC0415

        context = ray.get_runtime_context()
        given: dict[str, float] = context.get_assigned_resources()  # type: ignore[no-untyped-call]
        # Ray shows a task only the GPU that is its own.
        devices = ("cuda:0",) if given.get("GPU") else ("cpu",)
        machine = Machine(max(1, int(given.get("CPU", 1))), devices)
        return [asdict(record) for record in run_batch([Path(file) for file in chunk], self.order, machine)]


def _chunks(jobs: Sequence[Job], most: int) -> list[list[str]]:
    """Share out jobs, the longest first, those of one group together."""
    ordered = sorted(jobs, key=lambda job: (str(job.known.group), -job.work, job.number))
    size = max(1, min(most, -(-len(jobs) // CHUNKS_PER_MACHINE)))
    files = [str(Path(job.file).absolute()) for job in ordered]
    return [files[begin : begin + size] for begin in range(0, len(files), size)]


def _records(ended: Ended, by_path: dict[str, Job], order: Order) -> list[tuple[Job, Record]]:
    """Return what became of the jobs of a chunk."""
    found = {record.recipe: record for record in map(record_of, ended.records)}
    return [(by_path[path], found.get(path) or _lost(by_path[path], ended, order)) for path in ended.chunk]


def _lost(job: Job, ended: Ended, order: Order) -> Record:
    why = f"{job.file}: {ended.lost or 'nothing is known of it'}"
    made = made_of(job.known.provenance)
    return Record(job.file, job.known.name, Status.KILLED, made, options_of(order), error=why)
