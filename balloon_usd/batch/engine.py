"""The engine: recipes in, records out, with as many processes as the machine has use for."""

from __future__ import annotations

from collections import deque
from os import PathLike
from typing import TYPE_CHECKING, Self, TypeVar

from balloon_usd.batch import record as records
from balloon_usd.batch.error import BatchError
from balloon_usd.batch.facts import Facts, Refusal
from balloon_usd.batch.job import Job
from balloon_usd.batch.journal import FILE_NAME, Journal
from balloon_usd.batch.machine import Machine
from balloon_usd.batch.messages import Role, Started, Survey, Surveyed, Verified, Verify
from balloon_usd.batch.pool import Pool
from balloon_usd.batch.record import Record, Status
from balloon_usd.batch.scheduler import MOST_FAILED_STARTS, Scheduler
from balloon_usd.batch.watch import Overheard, Silence
from balloon_usd.processes.cores import usable_cores
from balloon_usd.processes.forking import prepare_fork

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from pathlib import Path

    from balloon_usd.batch.order import Order
    from balloon_usd.batch.watch import Watch
    from balloon_usd.batch.worker_process import Worker

CHUNK = 16
"""Recipes that a writer is asked about at a time, at most."""

FORKED = 3
"""Writers from which on it pays to load their modules once and fork them."""

Q = TypeVar("Q", Survey, Verify)
T = TypeVar("T", Surveyed, Verified)


def run_batch(
    recipes: Sequence[Path], order: Order, machine: Machine | None = None, watch: Watch | None = None
) -> list[Record]:
    """Make the stages of recipes, and return what became of each, in their order.

    What is in the output folder already, whole and made of the same recipe with the same options, is skipped.
    Wherever the run is interrupted or killed, the same call again ends in the same files. What a watch raises
    stops all, and comes back as it is.

    Raises:
        NotKept: the journal cannot be written.
        BatchError: there is no such device, workers cannot start, kernels cannot be compiled, or the journal
            cannot be read.
        TypeError: the recipes are one path, not a sequence of some.
    """
    if isinstance(recipes, (str, PathLike)):
        raise TypeError(f"{recipes!r} is one recipe, expected a list of them")
    told = watch or Silence()
    with Engine(order, machine or Machine(usable_cores()), told) as engine:
        return engine.make([str(recipe) for recipe in recipes])


class Engine:
    """One run of a batch on this machine."""

    def __init__(self, order: Order, machine: Machine, watch: Watch) -> None:
        """Prepare; used in a `with` block, at whose end all its processes are gone."""
        self.order, self.machine, self.watch = order, machine, Overheard(watch)
        self._pool = Pool(order)
        self._failed_starts = 0
        self._over = False
        """Whether all is made, and no simulator is needed any more."""

    def __enter__(self) -> Self:
        """Start nothing yet."""
        return self

    def __exit__(self, *_: object) -> None:
        """End all workers; those that have begun something remove it."""
        self._pool.close()

    def make(self, files: Sequence[str]) -> list[Record]:
        """Survey, verify and make recipes; see `run_batch`."""
        self.start_workers(len(files))
        jobs = [Job(number, file) for number, file in enumerate(files)]
        self._survey(jobs)
        _refuse_shared_names(jobs)
        accepted = [job for job in jobs if job.record is None]
        refused = [job.record for job in jobs if job.record is not None]
        if accepted and not (self.order.folder / FILE_NAME).exists():
            # A device that is missing is told before anything of the recipes.
            self._wait_for_simulators()
        self.watch.surveyed([job.known for job in accepted], refused)
        if accepted:
            try:
                self._make_accepted(jobs, accepted)
            except OSError as error:
                if error is self.watch.raised:
                    raise
                where = error.filename or self.order.folder
                raise BatchError(f"{where}: {error.strerror or error}") from error
        return [job.record for job in jobs if job.record is not None]

    def _make_accepted(self, jobs: Sequence[Job], accepted: Sequence[Job]) -> None:
        self.order.folder.mkdir(parents=True, exist_ok=True)
        journal = Journal(self.order.folder)
        for job in jobs:
            if job.record is not None:
                journal.add(job.record)
        todo = self._not_there_yet(accepted, journal)
        if todo:
            self.make_all(todo, journal)
            self._over = True
            self._tidy([job for job in todo if job.record and job.record.status is not Status.DONE])
        journal.put_in_order(job.file for job in jobs)

    def start_workers(self, recipes: int) -> None:
        """Start what is needed in any case, so that it gets ready while recipes are read."""
        for device in self.machine.first_simulators(recipes):
            self._pool.start(Role.SIMULATOR, device)
        self.start_writers(recipes)

    def start_writers(self, recipes: int) -> None:
        """Start as many writers as so many recipes keep busy."""
        writers = self.machine.writers(recipes)
        fork = prepare_fork("balloon_usd.batch.writer") if writers >= FORKED else False
        for _ in range(writers):
            self._pool.start(Role.WRITER, fork=fork)

    def make_all(self, jobs: Sequence[Job], journal: Journal) -> None:
        """Make jobs that are surveyed and not there yet; every one has its record then."""
        self._wait_for_simulators()
        Scheduler(jobs, self.order, self.machine, self._pool, journal, self.watch).run()

    def _wait_for_simulators(self) -> None:
        """Wait until the simulators that were started first can work, on every device that was asked for.

        Raises:
            BatchError: one cannot.
        """
        while any(worker.told is None for worker in self._pool.of(Role.SIMULATOR)):
            for worker, message in self._pool.heard():
                self._hear_start(worker, message)

    def _hear_start(self, worker: Worker, message: object | None) -> None:
        if self._over and worker.role is Role.SIMULATOR:
            return
        if message is None:
            self._failed_starts += 1
            if self._failed_starts >= MOST_FAILED_STARTS:
                raise BatchError(f"a {worker.role.value} process ended early: {worker.how_it_ended()}")
            self._pool.start(worker.role, worker.device)
        if isinstance(message, Started):
            worker.told = message
            if message.problem:
                raise BatchError(message.problem)
            if worker.role is Role.SIMULATOR and worker.device == "all":
                self._start_others(message.devices[1:])

    def _start_others(self, devices: Sequence[str]) -> None:
        """Start a simulator on each device that has none yet."""
        there = {worker.device for worker in self._pool.of(Role.SIMULATOR)}
        for device in devices:
            if device not in there:
                self._pool.start(Role.SIMULATOR, device)

    # Questions to writers.

    def _survey(self, jobs: Sequence[Job]) -> None:
        """Read and plan all recipes; those that are refused have their records then."""
        chunk = max(1, min(CHUNK, len(jobs) // (2 * len(self._pool.of(Role.WRITER)))))
        asked = deque(
            Survey(tuple((job.number, job.file) for job in jobs[begin : begin + chunk]))
            for begin in range(0, len(jobs), chunk)
        )

        def hear(message: Surveyed) -> None:
            for number, found in message.found:
                if isinstance(found, Facts):
                    jobs[number].facts = found
                else:
                    jobs[number].record = self._refused(jobs[number].file, found)

        self._ask(asked, Surveyed, hear)

    def _refused(self, file: str, found: Refusal) -> Record:
        return Record(
            file,
            found.name,
            Status.REFUSED,
            records.made_of(found.provenance) if found.provenance else {},
            records.options_of(self.order),
            error="\n".join(found.problems),
        )

    def _not_there_yet(self, accepted: Sequence[Job], journal: Journal) -> list[Job]:
        """Return the jobs whose files are not there, or not whole, and skip the others."""
        by_number = {job.number: job for job in accepted}
        known = {job.number: self._record_of(job, journal) for job in accepted}
        there = [(job, record) for job in accepted if (record := known[job.number]) is not None]
        asked = deque(
            Verify(tuple((job.number, record.name, record.files) for job, record in there[at : at + CHUNK]))
            for at in range(0, len(there), CHUNK)
        )

        def hear(message: Verified) -> None:
            for number, whole in message.whole:
                record = known[number]
                if whole and record is not None:
                    job = by_number[number]
                    job.record = records.skipped(record, job.file)
                    self.watch.ended(job.record)

        self._ask(asked, Verified, hear)
        return [job for job in accepted if job.record is None]

    def _tidy(self, jobs: Sequence[Job]) -> None:
        """Remove what killed writers left of sculptures that are not made again."""
        asked = deque([Verify(tuple((job.number, job.known.name, {}) for job in jobs))] if jobs else [])
        self._ask(asked, Verified, lambda _: None)

    def _record_of(self, job: Job, journal: Journal) -> Record | None:
        """Return the record of what is there already, if that is just what is asked for."""
        record = None if self.order.force else journal.of(job.known.name)
        # Results of a GPU and of the CPU differ in their last digits: one that was asked for must be it.
        kinds = {device.split(":")[0] for device in self.machine.devices} & {"cpu", "cuda"}
        kind = kinds.pop() if len(kinds) == 1 else ""
        return record if record is not None and record.fits(job.known, self.order, kind) else None

    def _ask(self, questions: deque[Q], kind: type[T], hear: Callable[[T], None]) -> None:
        """Ask writers, each one question at a time, until all are answered."""
        asked: dict[Worker, Q] = {}
        kills = 0
        while questions or asked:
            if not self._pool.of(Role.WRITER):
                self._pool.start(Role.WRITER)
            for writer in self._pool.of(Role.WRITER):
                if writer.ready and writer not in asked and questions:
                    asked[writer] = questions.popleft()
                    writer.send(asked[writer])
            for worker, message in self._pool.heard():
                if isinstance(message, kind):
                    asked.pop(worker, None)
                    hear(message)
                elif message is None and worker in asked:
                    kills += 1
                    if kills > len(self._pool.of(Role.WRITER)) + 1:
                        raise BatchError(f"writer processes end again and again: {worker.how_it_ended()}")
                    questions.appendleft(asked.pop(worker))
                    self._pool.start(Role.WRITER)
                else:
                    self._hear_start(worker, message)


def _refuse_shared_names(jobs: Iterable[Job]) -> None:
    """Refuse recipes that would write the files of an earlier one, also where capitals make no difference."""
    taken: dict[str, Job] = {}
    for job in jobs:
        if job.record is not None or job.facts is None:
            continue
        first = taken.setdefault(job.facts.name.casefold(), job)
        if first is not job:
            text = f'{job.file}: name: "{job.facts.name}" is taken by {first.file}'
            job.record = Record(job.file, job.facts.name, Status.REFUSED, error=text)
