"""Starting a process at the other end of a connection."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from contextlib import contextmanager
from multiprocessing.connection import Connection
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from balloon_usd.processes.forking import ForkedProcess

    Process = ForkedProcess | subprocess.Popen[bytes]


def connected(start: Callable[[int], Process]) -> tuple[Process, Connection[Any, Any]]:
    """Start a process with one end of a connection, as a descriptor; return it with the other end."""
    ours, theirs = socket.socketpair()
    try:
        with _interrupts_blocked():
            process = start(theirs.fileno())
    except BaseException:
        ours.close()
        raise
    finally:
        theirs.close()
    return process, Connection(ours.detach())


def spawn(
    words: list[str], descriptor: int, *, said: int | None = None, settings: Mapping[str, str] | None = None
) -> subprocess.Popen[bytes]:
    """Start a new interpreter that imports from where this process does.

    Args:
        words: for the interpreter; followed by the descriptor and the number of this process.
        descriptor: that it inherits.
        said: where it prints; absent where this process does.
        settings: for its environment, where that says nothing else.
    """
    os.set_inheritable(descriptor, True)
    return subprocess.Popen(  # noqa: S603  # our own module
        [sys.executable, "-P", *words, str(descriptor), str(os.getpid())],
        stdin=subprocess.DEVNULL,
        stdout=said,
        stderr=said,
        env={**(settings or {}), **os.environ, "PYTHONPATH": _import_paths()},
        pass_fds=(descriptor,),
    )


@contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Let no Ctrl-C reach a new process before it has said that it ignores them."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _import_paths() -> str:
    """Return what PYTHONPATH says to a process that imports from where this one does."""
    return os.pathsep.join(dict.fromkeys(path for path in sys.path if path))
