"""Copies of this process: they are ready at once, and share the memory of all modules.

Only where that is safe: on Linux, while this process has one thread and has not used a library that would not
survive it. Twelve writers so take 0.1 s to start instead of 2 s, and a gigabyte less.
"""

from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
import time
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

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


def fork(work: Callable[[], object], descriptor: int, said: int | None = None) -> ForkedProcess:
    """Do some work in a copy of this process, which ends with it.

    Args:
        work: what the copy does.
        descriptor: all that it keeps open of what belongs to this process, beside its standard streams.
        said: where it prints; absent where this process does.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    pid = os.fork()
    if pid:
        return ForkedProcess(pid)
    # Nothing of the parent's clean-up may run here.
    code = 1
    try:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        signal.signal(signal.SIGHUP, signal.SIG_DFL)
        if said is not None:
            _print_to(said)
        _close_all_but(descriptor)
        work()
        code = 0
    except BaseException:
        sys.excepthook(*sys.exc_info())
    finally:
        sys.stderr.flush()
        os._exit(code)


def _print_to(said: int) -> None:
    """Print to a descriptor from now on."""
    os.dup2(said, 1)
    os.dup2(said, 2)
    sys.stdout = sys.stderr = os.fdopen(2, "w", buffering=1, errors="backslashreplace", closefd=False)


def _close_all_but(descriptor: int) -> None:
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
