"""The scheduler: which worker does what next, and what happens when one is gone."""

from __future__ import annotations

from collections import Counter, defaultdict, deque
from dataclasses import replace
from typing import TYPE_CHECKING

from balloon_usd.batch import record as records
from balloon_usd.batch.error import BatchError
from balloon_usd.batch.job import BatchRun, Job
from balloon_usd.batch.machine import Device
from balloon_usd.batch.messages import (
    Begin,
    Copied,
    Draw,
    Drawn,
    Drop,
    Frames,
    Free,
    LaidOut,
    Made,
    NotDrawn,
    NotMade,
    Part,
    Ring,
    Role,
    Simulate,
    Simulated,
    Started,
    Trouble,
)
from balloon_usd.batch.record import Record, Status
from balloon_usd.batch.shared_memory import SharedMemory
from balloon_usd.batch.waiting import Waiting
from balloon_usd.batch.watch import Count
from balloon_usd.files.failed_name import failed_name

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from balloon_usd.batch.journal import Journal
    from balloon_usd.batch.machine import Machine
    from balloon_usd.batch.order import Order
    from balloon_usd.batch.pool import Pool
    from balloon_usd.batch.watch import Watch
    from balloon_usd.batch.worker_process import Worker

MOST_FAILED_STARTS = 3
"""Workers that may end before they are ready, before the batch is given up."""
SHEETS_AT_HAND = 2
"""Stages that a drawer has been given: the next one lies there when it is done with one."""
STATUS = {
    Trouble.NOT_WRITTEN: Status.NOT_WRITTEN,
    Trouble.FAILED: Status.FAILED,
    Trouble.UNFORESEEN: Status.UNFORESEEN,
    Trouble.KILLED: Status.KILLED,
    Trouble.DEVICE: Status.DEVICE,
}


class Scheduler:
    """Makes accepted jobs with the workers of a pool."""

    def __init__(
        self, jobs: Sequence[Job], order: Order, machine: Machine, pool: Pool, journal: Journal, watch: Watch
    ) -> None:
        """Prepare to make jobs that are surveyed and not there yet."""
        self._jobs = {job.number: job for job in jobs}
        self._order, self._machine, self._pool = order, machine, pool
        self._journal, self._watch = journal, watch
        self._devices: dict[str, Device] = {}
        self._most: dict[str, int] = {}
        """Sculptures in a batch at most, by device, where its memory has set a limit."""
        self._waiting = Waiting(jobs)
        self._runs: dict[int, BatchRun] = {}
        self._busy: dict[Worker, int] = {}
        """Simulators at work, with the numbers of their batches."""
        self._preparing: set[Worker] = set()
        """Simulators that have got a batch and not laid it out yet."""
        self._load: dict[Worker, int] = defaultdict(int)
        """Jobs of every writer."""
        self._undrawn: deque[Made] = deque()
        """Stages that wait for a drawer."""
        self._drawing: dict[int, tuple[Worker, Made]] = {}
        """Who draws the contact sheet of a job."""
        self._failed_starts = 0
        self._next = 0
        self._done = self._failed = 0

    def run(self) -> None:
        """Work until every job has its record.

        Raises:
            BatchError: workers cannot start, or kernels cannot be compiled.
            NotKept: the journal cannot be written.
        """
        for worker in self._pool.of(Role.SIMULATOR):
            if worker.ready:
                self._add_device(worker)
        self._start_drawers(self._machine.drawers(len(self._jobs)))
        self._watch.begun(self._device_names(), sum(job.known.frames for job in self._jobs.values()))
        while self._done + self._failed < len(self._jobs):
            self._hand_out()
            self._hand_out_sheets()
            for worker, message in self._pool.heard():
                if message is None:
                    self._lost(worker)
                else:
                    self.hear(worker, message)

    def hear(self, worker: Worker, message: object) -> None:
        """Act on what a worker says."""
        if isinstance(message, Started):
            self._started(worker, message)
        elif isinstance(message, Frames):
            self._pass_on(self._runs[message.batch], message)
        elif isinstance(message, Copied):
            self._copied(message, worker)
        elif isinstance(message, LaidOut):
            self._lay_out(self._runs[message.batch], message)
        elif isinstance(message, Made):
            self._made(message)
        elif isinstance(message, NotMade):
            self._given_up(message)
        elif isinstance(message, NotDrawn):
            _, made = self._drawing.pop(message.job)
            self._not_drawn(made, message.trouble, message.why)
        elif isinstance(message, Simulated):
            self._simulated(worker, message)
        elif isinstance(message, Drawn):
            _, made = self._drawing.pop(message.job)
            self._finish(made.with_sheet(message.files))
        else:
            raise TypeError(f"a worker said {type(message).__name__}")

    # Devices and workers.

    def _started(self, worker: Worker, told: Started) -> None:
        worker.told = told
        if worker.role is not Role.SIMULATOR:
            return
        if told.problem:
            self._pool.remove(worker)
            self._without_device(worker.device, told.problem)
            return
        self._failed_starts = 0
        self._add_device(worker)

    def _add_device(self, worker: Worker) -> None:
        told = worker.told
        assert told is not None, "only ready workers have a device"
        worker.device = told.device
        if told.device not in self._devices:
            self._devices[told.device] = Device(told.device, told.processors, told.free_bytes)
            self._most[told.device] = len(self._jobs)

    def _device_names(self) -> str:
        return ", ".join(self._devices)

    def _without_device(self, name: str, why: str) -> None:
        """Go on without a device that is gone."""
        if self._devices.pop(name, None) is None and self._devices:
            return
        if self._devices or any(worker.device != name for worker in self._pool.of(Role.SIMULATOR)):
            self._watch.said(f"{name}: {why}; going on without it")
        elif self._machine.may_fall_back and name != "cpu":
            self._watch.said(f"{name}: {why}; going on on the CPU")
            self._devices["cpu"], self._most["cpu"] = Device("cpu"), 1
        else:
            self._waiting.clear()
            for job in self._jobs.values():
                self._not_made(job, Trouble.DEVICE, f"{job.file}: {name}: {why}")

    # Handing out.

    def _hand_out(self) -> None:
        """Start what workers are missing, and give idle simulators the longest batch there is."""
        if not len(self._waiting):
            return
        self._start_workers()
        if not any(worker.ready for worker in self._pool.of(Role.WRITER)):
            return
        for worker in self._pool.of(Role.SIMULATOR):
            if worker.ready and worker not in self._busy and worker.device in self._devices:
                together = self._together(self._devices[worker.device])
                if self._should_wait(worker, together):
                    continue
                jobs = self._waiting.take(together)
                if not jobs and not (self._runs or self._drawing or self._undrawn):
                    jobs = self._waiting.take_alone()
                if not jobs:
                    return
                self._begin(worker, jobs)

    def _start_workers(self) -> None:
        left = len(self._waiting)
        if not self._pool.of(Role.WRITER):
            self._pool.start(Role.WRITER)
        for device in self._devices.values():
            there = [worker for worker in self._pool.of(Role.SIMULATOR) if worker.device == device.name]
            idle = sum(worker not in self._busy for worker in there)
            batches = -(-left // self._together(device))
            wanted = self._machine.simulators(device, len(there) - idle + batches)
            for _ in range(wanted - len(there)):
                self._pool.start(Role.SIMULATOR, device.name)

    def _should_wait(self, simulator: Worker, together: int) -> bool:
        """Whether a simulator is to wait for another one of its GPU that prepares a batch.

        If all prepared their batches at the same time, and ended them so, the GPU would be idle meanwhile.
        """
        others = [worker for worker in self._preparing if worker.device == simulator.device]
        return bool(others) and self._devices[simulator.device].is_gpu and len(self._waiting) > together

    def _together(self, device: Device) -> int:
        # All devices share the recipes, so that none is idle at the end.
        share = -(-len(self._jobs) // max(len(self._devices), 1))
        together = device.together(self._waiting.vertices, share)
        return min(self._most[device.name], together)

    def _begin(self, simulator: Worker, jobs: Sequence[Job]) -> None:
        number, self._next = self._next, self._next + 1
        parts = []
        by_writer: dict[Worker, list[Part]] = defaultdict(list)
        writers = [worker for worker in self._pool.of(Role.WRITER) if worker.ready]
        for place, job in enumerate(jobs):
            known = job.known
            part = Part(job.number, number, place, job.file, known.provenance, known.frames, known.plan)
            parts.append(part)
            writer = min(writers, key=lambda one: self._load[one])
            self._load[writer] += 1
            by_writer[writer].append(part)
            job.frames = 0
        self._runs[number] = BatchRun(number, simulator, by_writer)
        self._busy[simulator] = number
        self._preparing.add(simulator)
        threads = self._machine.threads(len(self._busy) + len(self._waiting))
        simulator.send(Simulate(number, tuple(parts), threads))
        for writer, own in by_writer.items():
            writer.send(Begin(number, tuple(own)))

    # Frames.

    def _lay_out(self, run: BatchRun, told: LaidOut) -> None:
        self._preparing.discard(run.simulator)
        memory = SharedMemory(told.size)
        try:
            name = memory.handle if isinstance(memory.handle, str) else ""
            ring = Ring(run.number, told.size, told.layout, name)
            for worker in (run.simulator, *run.writers):
                worker.send_ring(ring, memory)
        finally:
            memory.close()

    def _pass_on(self, run: BatchRun, frames: Frames) -> None:
        readers = run.lent(frames)
        for writer in readers:
            writer.send(frames)
        if not readers:
            run.simulator.send(Free(run.number, frames.slot))
        made = 0
        for number in list(run.writer):
            made += self._jobs[number].advance(run.advance(number, frames))
        self._watch.advanced(frames.doing, made, self._count())

    def _copied(self, told: Copied, writer: Worker) -> None:
        run = self._runs.get(told.batch)
        if run is not None and run.given_back(told.slot, writer):
            run.simulator.send(Free(told.batch, told.slot))

    def _count(self) -> Count:
        running = sum(len(run.writer) for run in self._runs.values())
        return Count(len(self._jobs), running, self._done, self._failed)

    # Ends.

    def _writes(self, told: Made | NotMade) -> bool:
        """Whether it is still awaited; a job that was taken from a batch is tried again in another one."""
        return told.batch in self._runs and told.job in self._runs[told.batch].writer

    def _made(self, made: Made) -> None:
        if not self._writes(made):
            return
        job = self._jobs[made.job]
        writer = self._runs[made.batch].writer[job.number]
        job.device = self._leave(job)
        if not self._order.preview:
            self._finish(made)
        elif self._pool.of(Role.DRAWER):
            self._undrawn.append(made)
        else:
            self._draw(made, writer)

    # Contact sheets.

    def _start_drawers(self, wanted: int) -> None:
        """Let there be so many drawers, shared by the GPUs; where there is none, writers draw."""
        gpus = [device.name for device in self._devices.values() if device.is_gpu]
        if self._order.preview and gpus:
            for number in range(len(self._pool.of(Role.DRAWER)), wanted):
                self._pool.start(Role.DRAWER, gpus[number % len(gpus)])

    def _hand_out_sheets(self) -> None:
        """Give every drawer a stage, and the next one; when nothing else is left to do, let more draw."""
        if self._undrawn and not (len(self._waiting) or self._runs):
            self._only_draw()
        busy = Counter(worker for worker, _ in self._drawing.values())
        for _ in range(SHEETS_AT_HAND):
            for drawer in self._pool.of(Role.DRAWER):
                if self._undrawn and drawer.ready and busy[drawer] < SHEETS_AT_HAND:
                    busy[drawer] += 1
                    self._draw(self._undrawn.popleft(), drawer)

    def _only_draw(self) -> None:
        """End the workers that are not needed any more, and start drawers in their place."""
        for worker in [*self._pool.of(Role.SIMULATOR), *self._pool.of(Role.WRITER)[1:]]:
            self._pool.remove(worker)
        self._start_drawers(self._machine.drawers(len(self._undrawn), alone=True))

    def _draw(self, made: Made, drawer: Worker) -> None:
        """Let the contact sheet of a stage be drawn."""
        job = self._jobs[made.job]
        self._drawing[made.job] = (drawer, made)
        stage = str(self._order.folder / made.products["stage"][0])
        name = failed_name(job.known.name) if made.failed else job.known.name
        drawer.send(Draw(made.job, stage, name, drawer.device or job.device))

    def _not_drawn(self, made: Made, trouble: Trouble, why: str) -> None:
        """End a job without its contact sheet; where its simulation failed, that stays the trouble."""
        if made.failed:
            self._finish(replace(made, failed=f"{made.failed}; {why}"))
        else:
            self._not_made(self._jobs[made.job], trouble, why)

    def _finish(self, made: Made) -> None:
        job = self._jobs[made.job]
        record_of = records.failed if made.failed else records.done
        self._end(job, record_of(job.file, job.known, self._order, job.device, made))

    def _given_up(self, told: NotMade) -> None:
        if self._writes(told):
            self._not_made(self._jobs[told.job], told.trouble, told.why)

    def _not_made(self, job: Job, trouble: Trouble, why: str) -> None:
        if job.record is not None:
            return
        for run in self._runs.values():
            if job.number in run.writer and trouble is not Trouble.FAILED:
                run.simulator.send(Drop(run.number, (job.number,)))
        device = self._leave(job) or job.device
        self._drawing.pop(job.number, None)
        self._end(
            job,
            Record(
                job.file,
                job.known.name,
                STATUS[trouble],
                records.made_of(job.known.provenance),
                records.options_of(self._order),
                device,
                error=why,
            ),
        )

    def _leave(self, job: Job) -> str:
        """Let a job go from its batch and its writer; return the device that simulated it."""
        device = ""
        for run in self._runs.values():
            if job.number in run.writer:
                self._load[run.writer.pop(job.number)] -= 1
                device = run.simulator.device
        self._forget_finished()
        return device

    def _forget_finished(self) -> None:
        busy = set(self._busy.values())
        for number in [n for n, run in self._runs.items() if not run.writer and n not in busy]:
            del self._runs[number]

    def _end(self, job: Job, record: Record) -> None:
        job.record = record
        if record.status is Status.DONE:
            self._done += 1
        else:
            self._failed += 1
        self._journal.add(record)
        self._watch.ended(record)

    def _simulated(self, simulator: Worker, told: Simulated) -> None:
        del self._busy[simulator]
        self._preparing.discard(simulator)
        run = self._runs[told.batch]
        if told.of_all:
            raise BatchError(told.problem)
        if told.of_recipe:
            self._halve(self._take_back(run, list(run.writer)), told.problem, Trouble.NOT_WRITTEN)
        elif told.problem:
            # Of a device that has failed once, nothing is known any more.
            self._pool.remove(simulator)
            jobs = self._take_back(run, list(run.writer))
            if told.of_device:
                self._device_trouble(simulator.device, jobs, told.problem)
            else:
                self._halve(jobs, told.problem, Trouble.UNFORESEEN)
        else:
            short = self._take_back(run, list(run.writer))
            self._halve(short, "the simulation ended before its last frame", Trouble.UNFORESEEN)
        self._forget_finished()

    def _device_trouble(self, name: str, jobs: list[Job], why: str) -> None:
        """Try again in smaller batches, in the end without the device."""
        if len(jobs) > 1:
            most = self._most[name] = max(1, min(self._most[name], len(jobs) // 2))
            self._watch.said(f"{name}: {why}; going on with {most} sculptures at a time")
            self._waiting.retry(jobs)
        elif jobs:
            self._waiting.retry(jobs)
            self._without_device(name, why)

    # Losses.

    def _lost(self, worker: Worker) -> None:
        how = worker.how_it_ended()
        if not worker.ready:
            self._failed_starts += 1
            if self._failed_starts >= MOST_FAILED_STARTS:
                raise BatchError(f"{worker.role.value} processes end before they are ready: {how}")
        else:
            self._watch.said(f"a {worker.role.value} process ended ({how}), its recipes are tried again")
        why = f"the {worker.role.value} process was killed twice ({how})"
        if worker.role is Role.SIMULATOR:
            number = self._busy.pop(worker, None)
            self._preparing.discard(worker)
            if number is not None:
                run = self._runs[number]
                self._halve(self._take_back(run, list(run.writer)), why, Trouble.KILLED)
        elif worker.role is Role.WRITER:
            self._try_apart(self._lose_writer(worker), why)
        else:
            self._lose_drawer(worker, why)
        self._forget_finished()

    def _take_back(self, run: BatchRun, numbers: Iterable[int]) -> list[Job]:
        """Take jobs back from their writers, but those whose frames these have all got."""
        jobs = [self._jobs[number] for number in numbers]
        lost = [job for job in jobs if not run.has_all_frames(job)]
        for job in lost:
            run.writer[job.number].send(Drop(run.number, (job.number,)))
            self._load[run.writer.pop(job.number)] -= 1
        return lost

    def _lose_writer(self, writer: Worker) -> list[Job]:
        """Take jobs from a writer that is gone, those whose contact sheets it was to draw included."""
        lost = [self._jobs[made.job] for made in self._taken_from(writer)]
        for run in self._runs.values():
            numbers, free = run.without(writer)
            lost += [self._jobs[number] for number in numbers]
            if numbers:
                run.simulator.send(Drop(run.number, tuple(numbers)))
            for slot in free:
                run.simulator.send(Free(run.number, slot))
        self._load.pop(writer, None)
        return lost

    def _lose_drawer(self, drawer: Worker, why: str) -> None:
        """Let others go on; the sheet that was begun is tried once more, as it may be to blame."""
        self._pool.start(Role.DRAWER, drawer.device)
        for number, made in enumerate(self._taken_from(drawer)):
            job = self._jobs[made.job]
            job.kills += drawer.ready and number == 0
            if job.kills > 1:
                self._not_drawn(made, Trouble.KILLED, f"{job.file}: {why}")
            else:
                self._undrawn.append(made)

    def _taken_from(self, drawer: Worker) -> list[Made]:
        """Take all contact sheets from a process that is gone, in the order in which it got them."""
        found = [made for worker, made in self._drawing.values() if worker is drawer]
        for made in found:
            del self._drawing[made.job]
        return found

    def _halve(self, jobs: list[Job], why: str, trouble: Trouble) -> None:
        """Try jobs of one batch again in two; of one alone, tell, or try it once more if it was killed."""
        if len(jobs) > 1:
            self._retry_in_two(jobs)
            return
        for job in jobs:
            job.kills += 1
            if trouble is Trouble.KILLED and job.kills <= 1:
                self._waiting.retry([job])
            else:
                named = why if trouble is Trouble.NOT_WRITTEN else f"{job.file}: {why}"
                self._not_made(job, trouble, named)

    def _try_apart(self, jobs: list[Job], why: str) -> None:
        """Try jobs of a killed writer again, in the end one at a time: halves may meet in a writer again."""
        if len(jobs) == 1:
            self._halve(jobs, why, Trouble.KILLED)
            return
        for job in jobs:
            job.losses += 1
            if job.losses > 1:
                self._waiting.retry_alone(job)
        self._retry_in_two([job for job in jobs if job.losses == 1])

    def _retry_in_two(self, jobs: list[Job]) -> None:
        middle = len(jobs) // 2
        self._waiting.retry(jobs[:middle])
        self._waiting.retry(jobs[middle:])
