"""A child process that opens stages of unknown origin: a damaged one may crash it, and the command goes on.

It is forked where that is safe, which takes milliseconds, and is a new interpreter elsewhere. On Windows the
work is done in this process.
"""

from __future__ import annotations

import glob
import os
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from functools import partial
from typing import IO, TYPE_CHECKING, Any, ParamSpec, Self, TypeVar

from balloon_usd.cli.child_memory import bytes_composed, bytes_there, memory_for
from balloon_usd.cli.failure import ExitCode, Failure
from balloon_usd.files.hidden import matching
from balloon_usd.processes.forking import fork, may_fork
from balloon_usd.processes.starting import connected, spawn

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from pathlib import Path

    from balloon_usd.processes.forking import ForkedProcess
    from balloon_usd.processes.starting import Process

P = ParamSpec("P")
T = TypeVar("T")

GRACE = 3.0
"""Time for a child to remove what it has begun, before it is killed (s)."""
GLANCE = 1.0
"""Time between two looks whether a child gets on (s)."""
STALLED = 300.0
"""Time without a sign of life after which a child is given up (s). It gives them while Python gets on: only a
call of a library keeps them off. Of those that a sound stage needs none takes nearly as long; the longest is
to compile the kernels of a new GPU."""
SERVE = "import sys; from balloon_usd.cli.child_work import serve; serve(int(sys.argv[1]), int(sys.argv[2]))"
"""What a new interpreter runs; not as a module of its own name, which would be imported twice."""


class DamagedError(Exception):
    """Work on a stage broke off as it does with damaged ones only; the message says in a few words how."""


class ChildProcess:
    """Does one call after the other in a child process, and in a new one after one that broke off."""

    def __init__(self) -> None:
        """Start nothing yet."""
        self._process: Process | None = None

    def __enter__(self) -> Self:
        """Start nothing yet; at the end of the block the child is gone."""
        return self

    def __exit__(self, *_: object) -> None:
        """End the child; one that is in the middle of something removes what it has begun."""
        self._end()

    def start(self) -> None:
        """Start the child if there is none: forked, as long as no library stands in the way."""
        if self._process is not None or sys.platform == "win32":
            return
        self._said = _scratch_file()
        start = partial(_fork if may_fork() else _spawn, self._said.fileno())
        self._process, self._connection = connected(start)

    def call(
        self, stages: Iterable[str | Path], function: Callable[P, T], *args: P.args, **kw: P.kwargs
    ) -> T:
        """Return what a function of a module gives in the child.

        Errors of this program and of the system are raised as in this process. What is printed meanwhile is
        held back, see `pass_on`.

        Args:
            stages: what it opens, which says how much memory it may take.
            function: what is called, with all that follows.
            args: for it.
            kw: for it.

        Raises:
            DamagedError: it ended in any other way.
        """
        if sys.platform == "win32":
            return function(*args, **kw)
        named = [str(stage) for stage in stages]
        allowed = memory_for(bytes_there(named))
        try:
            return self._call(allowed, function, *args, **kw)
        except DamagedError as error:
            damage = error
        if all(stage.lower().endswith(".usdz") for stage in named):
            raise damage
        # Others may be composed of large files that lie elsewhere.
        with suppress(DamagedError, OSError):
            more = memory_for(self._call(allowed, bytes_composed, named))
            if more > allowed:
                return self._call(more, function, *args, **kw)
        raise damage

    def _call(self, memory: int, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
        """Return what a function gives in the child with so much memory [B].

        Raises:
            DamagedError: it ended in any other way.
        """
        self.start()
        self._begin = os.fstat(self._said.fileno()).st_size
        try:
            self._connection.send((memory, function, args, kwargs))
            outcome, answer = self._answer()
        except (EOFError, ConnectionError) as error:
            raise DamagedError(self._how_it_ended()) from error
        if outcome == "broken":
            # Nobody knows in which state it left the libraries.
            self._end()
            raise DamagedError(answer)
        if outcome == "raised":
            raise answer
        result: T = answer
        return result

    def pass_on(self) -> None:
        """Print to the error stream what was printed during the last call, as warnings of libraries."""
        if self._process is None:
            return
        descriptor = self._said.fileno()
        said = os.pread(descriptor, os.fstat(descriptor).st_size - self._begin, self._begin)
        if said:
            sys.stderr.write(said.decode(errors="backslashreplace"))

    def _answer(self) -> Any:
        """Wait for what becomes of a call.

        Raises:
            DamagedError: there was no sign of life for long.
        """
        sign, seen = 0, time.monotonic()
        while not self._connection.poll(GLANCE):
            latest = os.fstat(self._said.fileno()).st_mtime_ns
            if latest != sign:
                sign, seen = latest, time.monotonic()
            elif time.monotonic() - seen > STALLED:
                self._end()
                raise DamagedError(f"reading it did not get on for {STALLED:g} s")
        return self._connection.recv()

    def _how_it_ended(self) -> str:
        """Say why a child that ended by itself did so."""
        assert self._process is not None, "it was started"
        code = self._process.wait()
        self._end()
        if code == -signal.SIGKILL:
            return "reading it was killed, perhaps for taking all memory"
        with suppress(ValueError):
            return f"reading it crashed ({signal.Signals(-code).name})"
        return f"reading it ended with exit code {code}"

    def _end(self) -> None:
        """End the child, if there is one."""
        process, self._process = self._process, None
        if process is None:
            return
        self._connection.close()
        try:
            process.terminate()
            process.wait(GRACE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        finally:
            self._said.close()


def read_in_child(
    stage: str, leftovers: tuple[Path, str], function: Callable[P, T], *args: P.args, **kwargs: P.kwargs
) -> T:
    """Call a function that opens a stage in a child process of its own.

    Args:
        stage: what the stage is called.
        leftovers: a folder, and the name of what the function makes in it: a child that crashes leaves
            unfinished files, which are removed.
        function: what is called, with all that follows.
        args: for it.
        kwargs: for it.

    Raises:
        Failure: the stage is damaged.
    """
    try:
        with ChildProcess() as child:
            result = child.call([stage], function, *args, **kwargs)
            child.pass_on()
            return result
    except DamagedError as error:
        raise Failure(f"{stage}: damaged: {error}", ExitCode.BAD_INPUT) from error
    finally:
        remove_unfinished(*leftovers)


def remove_unfinished(folder: Path, name: str) -> None:
    """Remove what a crashed child has begun in a folder under a name, but nothing that is still written."""
    start = f".{glob.escape(name)}"
    # An impossible path has been told.
    with suppress(OSError, ValueError):
        if not name or not matching(folder, f"{start}*"):
            return
        from balloon_usd.files.lock import remove_unheld  # noqa: PLC0415
        from balloon_usd.files.whole_file import PARTIAL  # noqa: PLC0415
        from balloon_usd.stage.workspace import sweep  # noqa: PLC0415

        for file in matching(folder, f"{start}*.????????{PARTIAL}"):
            remove_unheld(file)
        sweep(f"{start[1:]}*", folder)


def _scratch_file() -> IO[bytes]:
    """Return a file without a name: no pipe, which might be full, and not on a disk, which might be, too."""
    if sys.platform != "linux":
        return tempfile.TemporaryFile()
    return os.fdopen(os.memfd_create("said"), "w+b")


def _fork(said: int, connection: int) -> ForkedProcess:
    """Start a child as a copy of this process."""
    parent = os.getpid()

    def work() -> None:
        from balloon_usd.cli.child_work import serve  # noqa: PLC0415

        serve(connection, parent)

    return fork(work, connection, said)


def _spawn(said: int, connection: int) -> subprocess.Popen[bytes]:
    """Start a child as a new interpreter."""
    return spawn(["-c", SERVE], connection, said=said)
