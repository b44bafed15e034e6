"""Jobs that wait, by groups that can advance together, the longest first."""

from __future__ import annotations

from collections import defaultdict, deque
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable

    from balloon_usd.batch.job import Job


class Waiting:
    """Jobs that nobody works on yet, or that are to be tried again."""

    def __init__(self, jobs: Iterable[Job]) -> None:
        """Sort jobs: with the longest first, none of them is left alone at the end."""
        self._groups: dict[Hashable, deque[Job]] = defaultdict(deque)
        for job in sorted(jobs, key=lambda job: (-job.work, job.number)):
            self._groups[job.known.group].append(job)
        self._again: deque[list[Job]] = deque()
        self._alone: deque[Job] = deque()

    def __len__(self) -> int:
        """Return how many there are."""
        return sum(map(len, self._groups.values())) + sum(map(len, self._again)) + len(self._alone)

    @property
    def vertices(self) -> int:
        """Vertices of the sculpture that comes next."""
        group = self._first()
        return group[0].known.vertices if group else 1

    def retry(self, jobs: Iterable[Job]) -> None:
        """Let jobs be tried again, those of each group together."""
        groups: dict[Hashable, list[Job]] = defaultdict(list)
        for job in jobs:
            groups[job.known.group].append(job)
        self._again.extend(groups.values())

    def retry_alone(self, job: Job) -> None:
        """Let a job be tried again when nothing else is at work, for it may be what kills processes."""
        self._alone.append(job)

    def take_alone(self) -> list[Job]:
        """Take one job that is to be tried alone; none if none wait, or if others do."""
        if len(self) > len(self._alone):
            return []
        while self._alone:
            job = self._alone.popleft()
            if job.record is None:
                return [job]
        return []

    def take(self, most: int) -> list[Job]:
        """Take up to `most` jobs that advance together; none if none wait."""
        while self._again:
            jobs = [job for job in self._again.popleft() if job.record is None]
            if jobs:
                if len(jobs) > most:
                    self._again.appendleft(jobs[most:])
                return jobs[:most]
        group = self._first()
        return [group.popleft() for _ in range(min(most, len(group)))] if group else []

    def clear(self) -> None:
        """Wait for nothing more."""
        self._groups.clear()
        self._again.clear()
        self._alone.clear()

    def _first(self) -> deque[Job] | None:
        """Return the group of the longest job."""
        groups = [group for group in self._groups.values() if group]
        return max(groups, key=lambda group: group[0].work, default=None)
