"""A whole `balloon-usd run` of many recipes, timed from the start of its process to its end."""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from balloon_usd.bench.bench_recipes import CLASSIC_DOG
from balloon_usd.bench.session_memory import SessionMemory

PROGRESS = re.compile(r"progress (\d+)/(\d+) ")
NAME = re.compile(r"^name: .*$", re.MULTILINE)


@dataclass(frozen=True)
class BatchRun:
    """One measured command."""

    recipes: int
    frames: int
    """Of all recipes, on disk."""
    seconds: float
    """From the start of the process to its end."""
    first: float
    """From the start of the process until the first frames were made (s)."""
    steady: float
    """Frames per second from the first frames to the last."""
    memory: float
    """Most host memory of all its processes at a time [B]; no number where the system does not tell."""
    size: int
    """Of all stages [B]."""

    @property
    def rate(self) -> float:
        """Frames per second that reach the disk, all told."""
        return self.frames / self.seconds


class RunFailed(RuntimeError):  # noqa: N818
    """The command that was measured has failed."""


def batch_run(recipes: int, detail: str, device: str, *, jobs: int | None, frames: int | None) -> BatchRun:
    """Run the classic dog under so many names, and leave nothing behind.

    Raises:
        RunFailed: the command has failed.
    """
    with tempfile.TemporaryDirectory() as folder:
        there = Path(folder, "recipes")
        there.mkdir()
        for number in range(recipes):
            text = NAME.sub(f"name: dog_{number:05d}", CLASSIC_DOG)
            (there / f"dog_{number:05d}.yaml").write_text(text, encoding="utf-8")
        words = [str(there), "-o", f"{folder}/out", "--detail", detail, "--device", device]
        words += ["--no-preview", "--no-report", "--progress", "lines"]
        words += ["--jobs", str(jobs)] if jobs else []
        words += ["--frames", f":{frames}"] if frames else []
        return _timed(words, recipes, Path(folder, "out"))


def _timed(words: list[str], recipes: int, output: Path) -> BatchRun:
    begin = time.perf_counter()
    process = subprocess.Popen(  # noqa: S603  # our own module
        [sys.executable, "-m", "balloon_usd", "run", *words],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    moments: list[tuple[float, int]] = []
    told = ""
    assert process.stderr is not None, "its error stream is a pipe"
    with SessionMemory(process.pid) as memory:
        for line in process.stderr:
            if match := PROGRESS.match(line):
                moments.append((time.perf_counter() - begin, int(match[1])))
            elif "caution:" not in line:
                told = line.strip()
        code = process.wait()
    seconds = time.perf_counter() - begin
    made = [moment for moment in moments if moment[1]]
    if code or not made:
        raise RunFailed(f"the run that was measured ended with {code}: {told or 'without a word'}")
    (first, some), (last, frames) = made[0], made[-1]
    steady = (frames - some) / max(last - first, 1e-9)
    size = sum(file.stat().st_size for file in output.rglob("*") if file.is_file())
    return BatchRun(recipes, frames, seconds, first, steady, memory.most, size)
