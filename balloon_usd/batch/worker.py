"""A worker process: a simulator or a writer, `python -m balloon_usd.batch.worker ROLE DESCRIPTOR PARENT`.

One thread does all its work, so no two threads ever meet in OpenUSD. It ends when the connection does.
"""

from __future__ import annotations

import os
import signal
import sys
from multiprocessing.connection import Connection
from typing import TYPE_CHECKING, Any

from balloon_usd.batch.messages import Role, Start
from balloon_usd.endings import Terminated, never_dropped, terminate
from balloon_usd.loading import expect_modules
from balloon_usd.processes.ending import end_with

if TYPE_CHECKING:
    from balloon_usd.batch.simulator import Simulator
    from balloon_usd.batch.writer import Writer


def work(connection: Connection[Any, Any]) -> None:
    """Do what comes over the connection, until its other end is closed."""
    start = connection.recv()
    assert isinstance(start, Start), "a worker is told first what it is for"
    worker = _worker(connection, start)
    # Until now there is nothing to tidy up, and modules must not be loaded by halves.
    if start.role is not Role.SIMULATOR:
        signal.signal(signal.SIGTERM, terminate)
    try:
        with never_dropped(Terminated):
            worker.run()
    finally:
        worker.close()


def _worker(connection: Connection[Any, Any], start: Start) -> Simulator | Writer:
    if start.role is Role.SIMULATOR:
        from balloon_usd.batch.simulator import Simulator  # noqa: PLC0415

        return Simulator(connection, start)
    from balloon_usd.batch.writer import Writer  # noqa: PLC0415

    return Writer(connection, start)


def main(_role: str, descriptor: str, parent: str) -> None:
    """Work at the other end of an inherited connection, for the process of a number; the role is for eyes."""
    # Ctrl-C and SIGHUP reach the whole group of processes: the scheduler decides what they mean.
    for name in ("SIGINT", "SIGHUP"):
        if (number := getattr(signal, name, None)) is not None:
            signal.signal(number, signal.SIG_IGN)
    expect_modules()
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    end_with(int(parent), signal.SIGTERM)
    try:
        work(Connection(int(descriptor)))
    except (EOFError, BrokenPipeError, ConnectionResetError):
        # The scheduler is gone or wants no more. Devices and libraries are not taken down one by one.
        sys.stderr.flush()
        os._exit(0)
    except Terminated:
        os._exit(128 + signal.SIGTERM)


if __name__ == "__main__":
    main(*sys.argv[1:])
