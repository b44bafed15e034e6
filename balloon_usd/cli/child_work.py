"""What runs in a child process that opens stages: one call after the other, within limits."""

from __future__ import annotations

import os
import signal
import sys
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from balloon_usd.cli.child_memory import limit_memory
from balloon_usd.endings import Terminated, terminate
from balloon_usd.loading import expect_modules
from balloon_usd.processes.ending import end_with

if sys.platform != "win32":
    import resource

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    Outcome = tuple[Literal["done", "raised", "broken"], Any]

SIGN_OF_LIFE = 1.0
"""Time between two signs of life (s)."""
LONGEST = 160
"""Characters of a foreign error's message that are told."""
NO_FOLDER = os.devnull
"""In place of the folder in which OpenUSD would leave files about its crashes."""


def serve(descriptor: int, parent: int) -> None:
    """Do what comes over a connection for the process of a number, until the other end is closed."""
    signal.signal(signal.SIGTERM, terminate)
    # Ctrl-C and SIGHUP reach the whole group of processes: the parent decides what they mean.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    # What hangs in a library heeds no other signal.
    end_with(parent, signal.SIGKILL)
    expect_modules()
    _crash_without_traces()
    connection: Connection[Any, Any] = Connection(descriptor)
    with suppress(EOFError, ConnectionError, Terminated):
        while True:
            memory, function, args, kwargs = connection.recv()
            limit_memory(memory)
            outcome = _outcome(function, args, kwargs)
            sys.stdout.flush()
            sys.stderr.flush()
            _send(connection, outcome)
    # Devices and libraries are not taken down one by one.
    os._exit(0)


def _crash_without_traces() -> None:
    """Leave no files when a library crashes, and be the first to go when memory runs out."""
    resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
    # OpenUSD knows the first of these names only, Python the second as well.
    os.environ["TEMP"] = os.environ.get("TMPDIR", os.environ.get("TEMP", ""))
    os.environ["TMPDIR"] = NO_FOLDER
    with suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text("1000", encoding="ascii")


def _send(connection: Connection[Any, Any], outcome: Outcome) -> None:
    try:
        connection.send(outcome)
    except (ConnectionError, Terminated):
        raise
    except Exception as error:  # no pickle, or no text
        connection.send(("broken", _in_a_line(error)))


def _outcome(function: Callable[..., Any], args: Any, kwargs: Any) -> Outcome:
    """Make a call, with signs of life."""
    try:
        with _signs_of_life():
            return "done", function(*args, **kwargs)
    except MemoryError:
        return "broken", "it claims more than fits into memory"
    except Exception as error:  # that is what this is for
        ours = type(error).__module__.startswith("balloon_usd.")
        if ours or isinstance(error, click.ClickException | OSError | ImportError):
            return "raised", error
        return "broken", _in_a_line(error)


def _in_a_line(error: Exception) -> str:
    """Say what an error of a library or of Python is."""
    kind = type(error).__name__
    if type(error).__module__.startswith("pxr"):
        from balloon_usd.stage.opening import said_by  # noqa: PLC0415

        kind, said = "", said_by(error)
    else:
        said = " ".join(str(error).split())
    said = "".join(letter if letter.isprintable() else "?" for letter in said)
    short = said if len(said) <= LONGEST else f"{said[:LONGEST]}..."
    what = ": ".join(part for part in (kind, short) if part)
    return f"a value cannot be read ({what})" if what else "a value cannot be read"


@contextmanager
def _signs_of_life() -> Iterator[None]:
    """Touch the file for what is printed again and again, as long as Python gets to do anything."""
    signal.signal(signal.SIGALRM, lambda *_: os.utime(2))
    # Libraries may not know that a call of the system can be interrupted.
    signal.siginterrupt(signal.SIGALRM, False)
    signal.setitimer(signal.ITIMER_REAL, SIGN_OF_LIFE, SIGN_OF_LIFE)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
