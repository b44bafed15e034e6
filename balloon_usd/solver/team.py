"""Teams: threads of a CPU that advance one state together, each by a graph of its own.

Recorded is the same work for all: the first thread does what is not shared out, the others wait for it at
barriers. How many take part changes no bit of a frame.
"""

from __future__ import annotations

import ctypes
import sys
import threading
from concurrent.futures import ThreadPoolExecutor, wait
from functools import cache
from typing import TYPE_CHECKING, Any

import warp as wp

from balloon_usd.solver.pace import Pace

if TYPE_CHECKING:
    from collections.abc import Sequence
    from concurrent.futures import Future

MOST_THREADS = 16
"""Threads of a team at most: each has its graphs recorded, 37 ms each."""


@cache
def yield_processor() -> int:
    """Return the address of the operating system's function that yields a thread's processor to others."""
    if sys.platform == "win32":
        function = ctypes.windll.kernel32.SwitchToThread
    else:
        function = ctypes.CDLL(None).sched_yield
    return ctypes.cast(function, ctypes.c_void_p).value or 0


class Team:
    """Threads that replay graphs which wait for each other at barriers."""

    def __init__(self, most: int, barrier_counts: wp.array[int], barrier_rounds: wp.array[int]) -> None:
        """Prepare so many threads at most; a single one is the caller's."""
        most = min(most, MOST_THREADS)
        self._pace = Pace(most)
        self._counts, self._rounds = barrier_counts, barrier_rounds
        self._pool = ThreadPoolExecutor(most, "team") if most > 1 else None

    @property
    def threads(self) -> int:
        """How many threads the next replay is to have: as many as were fastest lately."""
        return self._pace.threads

    def replay(self, graphs: Sequence[Any]) -> None:
        """Replay a graph by each thread."""
        with self._pace.measured(len(graphs)):
            if self._pool is None or len(graphs) == 1:
                wp.capture_launch(graphs[0])
            else:
                self._replay_together(self._pool, graphs)

    def _replay_together(self, pool: ThreadPoolExecutor, graphs: Sequence[Any]) -> None:
        # What failed in a thread may have left others on their way to a barrier.
        self._counts.numpy().fill(0)
        self._rounds.numpy().fill(0)
        gate = _Gate()
        pending: list[Future[None]] = []
        try:
            pending.extend(pool.submit(gate.replay, graph) for graph in graphs)
            gate.complete = True
        finally:
            # None of the threads is interrupted, only the caller's: a team that has begun ends.
            gate.opened.set()
            wait(pending)
        for each in pending:
            each.result()


class _Gate:
    """What threads wait at until their team is complete: one that lacks a thread would wait for ever."""

    def __init__(self) -> None:
        self.opened = threading.Event()
        self.complete = False

    def replay(self, graph: Any) -> None:
        self.opened.wait()
        if self.complete:
            wp.capture_launch(graph)
