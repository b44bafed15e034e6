"""A process that simulates and tells its parent when it has got how far.

It is run as `python -m balloon_usd.bench.child`, with a `ChildTask` as JSON on its command line.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from dataclasses import asdict, dataclass
from itertools import islice
from typing import IO, Any

from balloon_usd.loading import expect_modules


@dataclass(frozen=True)
class ChildTask:
    """What a child does."""

    recipes: tuple[str, ...]
    """Texts of the recipes that it simulates together."""
    detail: str
    device: str
    frames: int = 0
    """Frames to time once the parent has sent a line; 0 ends before that."""


class Child:
    """A process at work on a task."""

    def __init__(self, task: ChildTask, cache: str | None = None) -> None:
        """Start it; `cache`: folder for its compiled kernels, else the usual one."""
        environment = dict(os.environ, **({"WARP_CACHE_PATH": cache} if cache else {}))
        command = [sys.executable, "-m", "balloon_usd.bench.child", json.dumps(asdict(task))]
        self._begin = time.time()
        self._process = subprocess.Popen(  # noqa: S603  # our own module
            command,
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def first_frame(self) -> float:
        """Wait for the first frame and return the time from the start of the process (s)."""
        return self._told() - self._begin

    def run(self) -> None:
        """Let it go on with the frames that are timed."""
        _open(self._process.stdin).write("go\n")
        _open(self._process.stdin).flush()

    def seconds(self) -> float:
        """Wait for those frames and return the time that they took (s)."""
        return self._told()

    def end(self) -> None:
        """End it, whatever it is at."""
        self._process.kill()
        self._process.communicate()

    def _told(self) -> float:
        line = _open(self._process.stdout).readline()
        if not line:
            _, told = self._process.communicate()
            cause = (told.strip().splitlines() or ["without a word"])[-1]
            raise ChildError(f"a process that was measured ended with {self._process.returncode}: {cause}")
        return float(line)


class ChildError(RuntimeError):
    """A process that was measured has ended before its time."""


def _open(stream: IO[str] | None) -> IO[str]:
    if stream is None:
        raise ChildError("a process that was measured has no pipe")
    return stream


def work(task: ChildTask) -> None:
    """Simulate; print the time of the first frame that was computed (s since the epoch), then how long the
    frames to time took (s).
    """
    # As every command does.
    expect_modules()
    import warp as wp  # noqa: PLC0415

    wp.config.log_level = wp.LOG_WARNING
    # Frames are made to be written: what writes them belongs to the start.
    import balloon_usd.stage  # noqa: F401, PLC0415
    from balloon_usd.bench.timing import planned  # noqa: PLC0415
    from balloon_usd.solver.simulation import simulate_many  # noqa: PLC0415

    # There is a process for each core.
    plans = [planned(text) for text in task.recipes]
    frames = simulate_many(plans, task.detail, task.device, threads=1).frames()
    for _ in range(2):
        next(frames)
    _tell(time.time())
    if task.frames:
        sys.stdin.readline()
        begin = time.perf_counter()
        made = sum(1 for _ in islice(frames, task.frames))
        # An animation that is over sooner is told as if it had gone on.
        _tell((time.perf_counter() - begin) * task.frames / max(made, 1))


def _tell(value: float) -> None:
    sys.stdout.write(f"{value!r}\n")
    sys.stdout.flush()


def main(argument: str) -> None:
    """Do the task that is told as JSON."""
    told: dict[str, Any] = json.loads(argument)
    work(ChildTask(tuple(told.pop("recipes")), **told))


if __name__ == "__main__":
    main(sys.argv[1])
