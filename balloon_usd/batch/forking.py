"""Workers as copies of this process: they are ready at once, and share the memory of all modules.

Only where that is safe: on Linux, while this process has one thread and has not used a library that would not
survive it. Twelve writers so take 0.1 s to start instead of 2 s, and a gigabyte less.
"""

from __future__ import annotations

import ctypes
import gc
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator


THREADS = Path("/proc/self/task")
"""Where Linux lists the threads of a process, those of libraries too."""
ONE_THREAD = {
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "PXR_WORK_THREAD_LIMIT": "1",
    # OpenUSD would tell of the line above.
    "TF_ENV_SETTING_ALERTS_ENABLED": "0",
}
"""Settings by which libraries use one thread: there is a process for each core. Threads of OpenUSD took 15 %
more processor time, to no avail."""
UNSAFE = ("pxr", "warp")
"""Libraries of which nobody knows what they have done in this process before."""
PR_SET_PDEATHSIG = 1
"""Of `prctl` on Linux: the signal that a process gets when the one that started it is gone."""
POLL = 0.005
"""Time between two looks for the end of a process (s)."""


def prepare_fork(module: str) -> bool:
    """Load what forked workers run, and return whether they may be forked."""
    if not may_fork():
        return False
    os.environ.update(ONE_THREAD | os.environ)
    import_module(module)
    # What was made until now stays as it is: no copy of it is touched by collecting garbage.
    gc.collect()
    gc.freeze()
    return _one_thread()


def may_fork() -> bool:
    """Whether a copy of this process could do anything that a new one can."""
    return sys.platform == "linux" and not any(name in sys.modules for name in UNSAFE) and _one_thread()


def _one_thread() -> bool:
    return len(list(THREADS.iterdir())) == 1


class ForkedProcess:
    """A forked process, with what is needed of `subprocess.Popen`."""

    def __init__(self, pid: int) -> None:
        self.pid = pid
        self._code: int | None = None

    def poll(self) -> int | None:
        """Return its exit code, negative after a signal; None while it lives."""
        if self._code is None:
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            if pid:
                self._code = os.waitstatus_to_exitcode(status)
        return self._code

    def wait(self, timeout: float | None = None) -> int:
        """Wait for its end.

        Raises:
            subprocess.TimeoutExpired: it lives on.
        """
        begin = time.monotonic()
        while (code := self.poll()) is None:
            if timeout is not None and time.monotonic() - begin > timeout:
                raise subprocess.TimeoutExpired(str(self.pid), timeout)
            time.sleep(POLL)
        return code

    def terminate(self) -> None:
        """Ask it to end."""
        self._signal(signal.SIGTERM)

    def kill(self) -> None:
        """End it at once."""
        self._signal(signal.SIGKILL)

    def _signal(self, number: int) -> None:
        if self.poll() is None:
            os.kill(self.pid, number)


def close_all_but(descriptor: int) -> None:
    """Close what belongs to the parent: a connection that is open anywhere does not end with its process."""
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    for name in os.listdir("/proc/self/fd"):  # noqa: PTH208
        if int(name) not in {0, 1, 2, descriptor}:
            try:
                os.close(int(name))
            except OSError:
                # The one that lists them.
                continue


@contextmanager
def interrupts_blocked() -> Iterator[None]:
    """Let no Ctrl-C reach a new process before it has said that it ignores them."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def import_paths() -> str:
    """Return what PYTHONPATH says to a process that imports from where this one does."""
    return os.pathsep.join(dict.fromkeys(path for path in sys.path if path))


def end_with(parent: int, number: int) -> None:
    """Let the system send this process a signal when its parent is gone, also within a long call."""
    if sys.platform != "linux":
        return
    with suppress(AttributeError, OSError):
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, number)
    if os.getppid() != parent:
        os._exit(0)
