"""Jobs: recipes on their way to their records."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from balloon_usd.batch.facts import Facts
    from balloon_usd.batch.messages import Frames, Part
    from balloon_usd.batch.record import Record
    from balloon_usd.batch.worker_process import Worker


@dataclass
class Job:
    """One recipe of a batch."""

    number: int
    file: str
    facts: Facts | None = None
    """Known once it is surveyed and accepted."""
    record: Record | None = None
    """Known at its end."""
    kills: int = 0
    """How often a process was killed that was at work on this job alone."""
    losses: int = 0
    """How often a writer was killed that had this job among others."""
    device: str = ""
    """Simulated it, once its stage is made."""
    frames: int = 0
    """Frames that were simulated in the present try."""
    shown: int = 0
    """Frames that progress has counted, in all tries."""

    @property
    def known(self) -> Facts:
        """The facts of an accepted recipe."""
        assert self.facts is not None, "only accepted recipes are made"
        return self.facts

    def advance(self, frames: int) -> int:
        """Count simulated frames; return how many of them are further than any try before came."""
        self.frames += frames
        news = max(0, self.frames - self.shown)
        self.shown += news
        return news

    @property
    def work(self) -> float:
        """How long it takes, against others."""
        return float(self.known.frames) * self.known.vertices


class BatchRun:
    """Some jobs that advance together, from a simulator to writers."""

    def __init__(self, number: int, simulator: Worker, writers: dict[Worker, list[Part]]) -> None:
        """Begin with every job at one writer."""
        self.number = number
        self.simulator = simulator
        self.parts = {part.job: part for parts in writers.values() for part in parts}
        self.writer = {part.job: writer for writer, parts in writers.items() for part in parts}
        """Writers of the jobs that are not over."""
        self._readers: dict[int, set[Worker]] = {}
        """Writers that still need a slot."""

    @property
    def writers(self) -> set[Worker]:
        """Writers that are still at work on it."""
        return set(self.writer.values())

    def lent(self, frames: Frames) -> set[Worker]:
        """Lend a slot to the writers that need it, and return them."""
        readers = self.writers
        if readers:
            self._readers[frames.slot] = set(readers)
        return readers

    def given_back(self, slot: int, writer: Worker) -> bool:
        """Take a slot back from a writer; return whether nobody needs it any more."""
        readers = self._readers.get(slot)
        if readers is None:
            return False
        readers.discard(writer)
        if readers:
            return False
        del self._readers[slot]
        return True

    def without(self, writer: Worker) -> tuple[list[int], list[int]]:
        """Go on without a writer that is gone; return its jobs, and the slots that nobody needs now."""
        jobs = [job for job, one in self.writer.items() if one is writer]
        for job in jobs:
            del self.writer[job]
        free = [slot for slot in list(self._readers) if self.given_back(slot, writer)]
        return jobs, free

    def advance(self, job: int, frames: Frames) -> int:
        """Return how many of some frames show a job, which ends before the one in which it fails."""
        part = self.parts[job]
        if failed := frames.failed.get(part.place):
            part = self.parts[job] = replace(part, last=min(part.last, failed[0] - 1))
        return max(0, min(frames.first + frames.count, part.last + 1) - frames.first)

    def has_all_frames(self, job: Job) -> bool:
        """Whether there is nothing more to come of a job."""
        return job.frames >= self.parts[job.number].last
