"""Memory of all processes of a session, watched while they run."""

from __future__ import annotations

import math
import threading
from contextlib import suppress
from pathlib import Path
from typing import Self

PROCESSES = Path("/proc")
"""Where Linux tells of processes."""
SESSION = 3
"""Place of the session's number behind the name of a process, in what Linux tells of it."""
KIBI = 1024.0
"""Bytes of the unit in which memory is told."""
EVERY = 0.25
"""Time between two looks (s)."""


class SessionMemory:
    """Looks at the memory of a session from time to time, in a thread; what processes share counts once."""

    def __init__(self, session: int) -> None:
        """Choose a session by its number, that of its first process."""
        self._session = session
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self.most = math.nan
        """Most that all took at a time [B]; no number where the system does not tell."""

    def __enter__(self) -> Self:
        """Begin to look."""
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        """End looking."""
        self._over.set()
        self._thread.join()

    def _watch(self) -> None:
        while not self._over.wait(EVERY):
            taken = sum(map(_memory, self._processes()))
            if taken and not taken <= self.most:
                self.most = taken

    def _processes(self) -> list[Path]:
        found = []
        for stat in PROCESSES.glob("[0-9]*/stat"):
            with suppress(OSError, ValueError, IndexError):
                if int(stat.read_text().rpartition(")")[2].split()[SESSION]) == self._session:
                    found.append(stat.parent)
        return found


def _memory(process: Path) -> float:
    """Return the memory of a process, with its share of what it has together with others [B]."""
    with suppress(OSError, ValueError, IndexError):
        for line in (process / "smaps_rollup").read_text().splitlines():
            if line.startswith("Pss:"):
                return KIBI * float(line.split()[1])
    return 0.0
