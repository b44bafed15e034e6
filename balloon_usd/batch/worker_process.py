"""Worker processes: started, told, asked to end."""

from __future__ import annotations

import os
import signal
import subprocess
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING

from balloon_usd.batch.channel import send_ring
from balloon_usd.processes.forking import ONE_THREAD, fork
from balloon_usd.processes.starting import connected, spawn

if TYPE_CHECKING:
    from balloon_usd.batch.messages import Ring, Role, Started
    from balloon_usd.batch.shared_memory import SharedMemory
    from balloon_usd.processes.forking import ForkedProcess

WORKER = "balloon_usd.batch.worker"
"""Module that workers run."""


class Worker:
    """A process of this program at the other end of a connection.

    A new interpreter runs a module of its own, so that a script that calls this program needs no guard
    against being imported again. A forked process has all modules from the start, and shares their memory.
    """

    def __init__(self, role: Role, device: str, *, fork: bool = False) -> None:
        """Start the process; `fork`: as a copy of this one, see `processes.forking`."""
        self.role = role
        self.device = device
        """Device that it was started for; its full name once it has told."""
        self._process, self.connection = connected(partial(_fork if fork else _spawn, role))
        self.told: Started | None = None
        """What it said when it was ready."""

    @property
    def ready(self) -> bool:
        """Whether it can work."""
        return self.told is not None and not self.told.problem

    @property
    def process_id(self) -> int:
        """Number of the process."""
        return self._process.pid

    def send(self, message: object) -> None:
        """Tell it something; a worker that is gone is found out when its connection is read."""
        # What was begun by a worker that has been removed may go on elsewhere: nobody is told then.
        if not self.connection.closed:
            with suppress(BrokenPipeError, ConnectionResetError):
                self.connection.send(message)

    def send_ring(self, ring: Ring, memory: SharedMemory) -> None:
        """Tell it of a ring and hand over its memory."""
        with suppress(BrokenPipeError, ConnectionResetError):
            send_ring(self.connection, ring, memory, self.process_id)

    def close(self) -> None:
        """Close the connection, which ends the process in its own time."""
        self.connection.close()

    def wait(self, seconds: float) -> bool:
        """Wait for its end; return whether that came in time."""
        try:
            self._process.wait(seconds)
        except subprocess.TimeoutExpired:
            return False
        return True

    def end(self) -> None:
        """Ask it to end now: a writer removes what is half-written before."""
        self._process.terminate()

    def kill(self) -> None:
        """End it at once."""
        self._process.kill()
        self._process.wait()

    def how_it_ended(self) -> str:
        """Say how it ended, as "SIGKILL" or "exit code 1"."""
        code = self._process.wait()
        if code >= 0:
            return f"exit code {code}"
        with suppress(ValueError):
            return signal.Signals(-code).name
        return f"signal {-code}"


def _spawn(role: Role, descriptor: int) -> subprocess.Popen[bytes]:
    """Start a new interpreter that works at the other end of a connection."""
    return spawn(["-m", WORKER, role.value], descriptor, settings=ONE_THREAD)


def _fork(role: Role, descriptor: int) -> ForkedProcess:
    """Start a worker at the other end of a connection as a copy of this process."""
    parent = str(os.getpid())

    def work() -> None:
        from balloon_usd.batch.worker import main  # noqa: PLC0415

        main(role.value, str(descriptor), parent)

    return fork(work, descriptor)
