"""The pace of a team: how many threads are fastest just now.

Other programs may need the same cores, and threads that wait at barriers for one without a core are slower
than one alone. So now and then a few frames are made by half as many or twice as many, and timed.
"""

from __future__ import annotations

import time
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

TRIAL = 3
"""Frames of a trial."""
FIRST_TRIAL = 16
"""Frames before the first trial, and between one that changed something and the next."""
LAST_TRIAL = 256
"""Frames between two trials at most: each one that changes nothing doubles them."""
WORTH = 0.95
"""Share of the present time below which another number of threads is taken."""


class Pace:
    """Measured times of frames by more and by fewer threads."""

    def __init__(self, most: int) -> None:
        """Begin with all threads, at most so many."""
        self._most = most
        self._usual = most
        """Threads between trials."""
        self._more = False
        """Whether the next trial is with more, if there are any."""
        self._until_trial = self._between = FIRST_TRIAL
        self._before: list[float] = []
        """Durations of the last frames by the usual number, s."""
        self._trial: list[float] = []
        """Durations of the frames of this trial, s."""

    @property
    def threads(self) -> int:
        """How many threads are to make the next frame."""
        if self._until_trial > 0 or self._most == 1:
            return self._usual
        return self._other

    @property
    def _other(self) -> int:
        """How many threads are tried."""
        if self._usual == 1 or (self._more and self._usual < self._most):
            return min(2 * self._usual, self._most)
        return (self._usual + 1) // 2

    @contextmanager
    def measured(self, threads: int) -> Iterator[None]:
        """Measure the frame that so many threads make during the block."""
        begin = time.perf_counter()
        yield
        self.note(threads, time.perf_counter() - begin)

    def note(self, threads: int, seconds: float) -> None:
        """Take note of a frame."""
        if threads == self._usual:
            self._before = [*self._before[1 - TRIAL :], seconds]
            self._until_trial -= 1
            return
        self._trial.append(seconds)
        if len(self._trial) < TRIAL:
            return
        # The shortest: what comes between by chance only makes frames longer.
        if min(self._trial) < WORTH * min(self._before):
            self._usual, self._before, self._between = threads, self._trial, FIRST_TRIAL
        else:
            self._more = not self._more
            self._between = min(2 * self._between, LAST_TRIAL)
        self._trial, self._until_trial = [], self._between
