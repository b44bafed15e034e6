"""Teams: threads of a CPU that advance one state together, each by a graph of its own.

Recorded is the same work for all: the first thread does what is not shared out, the others wait for it at
barriers. How many take part changes no bit of a frame.
"""

from __future__ import annotations

import ctypes
import sys
from concurrent.futures import ThreadPoolExecutor, wait
from functools import cache
from typing import TYPE_CHECKING, Any

import warp as wp

from balloon_usd.solver.kernels.device.barrier import ABANDONED
from balloon_usd.solver.pace import Pace

if TYPE_CHECKING:
    from collections.abc import Sequence


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
        """Prepare so many threads at most, the caller's among them."""
        self._pace = Pace(most)
        self._counts, self._rounds = barrier_counts, barrier_rounds
        self._others = ThreadPoolExecutor(most - 1, "team") if most > 1 else None

    @property
    def threads(self) -> int:
        """How many threads the next replay is to have: as many as were fastest lately."""
        return self._pace.threads

    def replay(self, graphs: Sequence[Any]) -> None:
        """Replay a graph by each thread, the first by the caller's."""
        with self._pace.measured(len(graphs)):
            if self._others is None or len(graphs) == 1:
                wp.capture_launch(graphs[0])
            else:
                self._replay_together(self._others, graphs)

    def _replay_together(self, others: ThreadPoolExecutor, graphs: Sequence[Any]) -> None:
        self._counts.numpy().fill(0)
        self._rounds.numpy().fill(0)
        pending = []
        try:
            pending += [others.submit(wp.capture_launch, graph) for graph in graphs[1:]]
            wp.capture_launch(graphs[0])
        except BaseException:
            # An interrupt before the first thread has begun: the others would wait for ever.
            self._rounds.numpy().fill(ABANDONED)
            raise
        finally:
            wait(pending)
