"""Start processes whose threads all begin with OpenUSD at once; says which ones failed or never ended.

    python starts.py first_calls 50

One process forks them all before it makes a call of OpenUSD, which is ten times as quick as starting them.
"""

from __future__ import annotations

import os
import signal
import sys
import sysconfig
import threading
import time
import traceback
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory

LIMIT = 20.0
"""Time after which a process has got stuck (s): they take less than one."""
SWITCHES = 1e-6
"""Time between switches of threads (s): the shorter, the likelier two threads meet."""


def first_calls(number: int, folder: Path) -> None:
    """Write a stage: the first calls of the process, whose modules are loaded."""
    from balloon_usd.stage import write_stage  # noqa: PLC0415
    from tests.stage.tubes import frames, sculpture  # noqa: PLC0415

    write_stage(sculpture(), frames(2), folder / str(number), flat=True)


def names(number: int, folder: Path) -> None:
    """Take a name of the package, which loads what it needs, each thread another one."""
    import balloon_usd  # noqa: PLC0415

    known = [name for name in balloon_usd.__all__ if name != "__version__"]
    getattr(balloon_usd, known[number % len(known)])


def beside_imports(number: int, folder: Path) -> None:
    """Load OpenUSD in one thread, and other compiled modules in the others."""
    if number == 0:
        import_module("balloon_usd.stage")
        return
    for file in Path(sysconfig.get_config_var("DESTSHARED")).glob("*.so"):
        # The first thread needs some milliseconds until it comes to OpenUSD.
        time.sleep(0.001)
        with suppress(ImportError):
            import_module(file.name.partition(".")[0])


KINDS = {
    "first_calls": (first_calls, 4, ("balloon_usd.stage", "tests.stage.tubes")),
    "names": (names, 16, ("balloon_usd",)),
    "beside_imports": (beside_imports, 2, ("balloon_usd", "numpy")),
}
"""What each thread does, how many threads, and what is loaded before they begin."""


def start(kind: str, folder: Path) -> None:
    """Let all threads do one thing at once, and end the process."""
    sys.setswitchinterval(SWITCHES)
    act, count, _ = KINDS[kind]
    ready = threading.Barrier(count)
    failed = threading.Event()

    def run(number: int) -> None:
        ready.wait()
        try:
            act(number, folder)
        except BaseException:
            traceback.print_exc()
            failed.set()

    threads = [threading.Thread(target=run, args=(number,)) for number in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    os._exit(failed.is_set())


def outcome(pid: int) -> str:
    """Wait for a process; return what was wrong with it."""
    deadline = time.monotonic() + LIMIT
    while time.monotonic() < deadline:
        ended, status = os.waitpid(pid, os.WNOHANG)
        if ended:
            return f"ended with {os.waitstatus_to_exitcode(status)}" if status else ""
        time.sleep(0.01)
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    return f"hung for {LIMIT:g} s"


def main(kind: str, count: int) -> None:
    for name in KINDS[kind][2]:
        import_module(name)
    for number in range(count):
        with TemporaryDirectory() as folder:
            pid = os.fork()
            if pid == 0:
                start(kind, Path(folder))
            wrong = outcome(pid)
        if wrong:
            print(f"process {number + 1} of {count} {wrong}", flush=True)
            if wrong.startswith("hung"):
                return


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
