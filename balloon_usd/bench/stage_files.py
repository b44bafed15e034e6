"""How fast stages are written, checked and compared, and how much memory that takes."""

from __future__ import annotations

import os
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from balloon_usd.bench.long_animation import NAME, long_description, long_frames, long_mesh
from balloon_usd.bench.machine import peak_memory
from balloon_usd.check import check_file
from balloon_usd.check.nvidia import nvidia_installed
from balloon_usd.diff import compare_files
from balloon_usd.stage import write_stage

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

FRAMES = 1000
"""Frames that are written unless others are asked for."""
PART = 10
"""Share of the frames with which memory is compared, as a divisor."""
BLOCK = 8 * 2**20
"""Bytes of one plain write."""


@dataclass(frozen=True)
class Chore:
    """What was done with stages, in a process of its own."""

    name: str
    seconds: float
    memory: float
    """Most memory that the process took (B)."""
    size: int
    """Bytes on disk that were written or read."""


@dataclass(frozen=True)
class Chores:
    """All of them with one number of frames."""

    vertices: int
    frames: int
    plain: Chore
    write: Chore
    check: Chore
    with_nvidia: Chore | None
    """The same with NVIDIA's validator, where that is installed."""
    diff: Chore


def stage_chores(frames: int) -> Chores:
    """Write a stage of so many frames, check it, and compare it with one in which a vertex has moved."""
    with TemporaryDirectory() as folder:
        one, other = Path(folder, "one"), Path(folder, "other")
        written = _apart(_written, one, frames, False)
        _apart(_written, other, frames, True)
        stages = one / NAME, other / NAME
        size = _size(stages[0])
        plain = Chore("plain write", *_apart(_plain, Path(folder, "plain"), size), size)
        check = Chore("check", *_apart(_checked, stages[0], False), size)
        asked = _apart(_checked, stages[0], True) if nvidia_installed() else None
        return Chores(
            vertices=len(long_mesh().points),
            frames=frames,
            plain=plain,
            write=Chore("write", *written, size),
            check=check,
            with_nvidia=Chore("check with NVIDIA's", *asked, size) if asked else None,
            diff=Chore("diff", *_apart(_compared, *stages), size + _size(stages[1])),
        )


def _apart(what: Callable[..., float], *arguments: Any) -> tuple[float, float]:
    """Do something in a process of its own; return its seconds and the most memory (B) that it took."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as process:
        return process.submit(_measured, what, arguments).result()


def _measured(what: Callable[..., float], arguments: tuple[Any, ...]) -> tuple[float, float]:
    seconds = what(*arguments)
    return seconds, peak_memory()


def _written(folder: Path, frames: int, moved: bool) -> float:
    """Write a stage down to the disk; return the time (s) without that for making up the frames."""
    mesh = long_mesh()
    watch = _Watch(long_frames(mesh, frames, moved=moved))
    begin = time.perf_counter()
    for file in write_stage(long_description(mesh), watch, folder).files:
        _sync(file)
    return time.perf_counter() - begin - watch.seconds


def _plain(file: Path, size: int) -> float:
    """Write as many bytes down to the disk without a thought; return the time (s)."""
    block = os.urandom(BLOCK)
    begin = time.perf_counter()
    with file.open("wb") as stream:
        for at in range(0, size, BLOCK):
            stream.write(block[: size - at])
    _sync(file)
    return time.perf_counter() - begin


def _checked(stage: Path, nvidia: bool) -> float:
    """Check a stage in all its variants; return the time (s)."""
    begin = time.perf_counter()
    check_file(str(stage), nvidia=nvidia)
    return time.perf_counter() - begin


def _compared(one: Path, other: Path) -> float:
    """Compare two stages; return the time (s)."""
    begin = time.perf_counter()
    compare_files(one, other)
    return time.perf_counter() - begin


class _Watch:
    """Passes things on and sums up the time that making them takes."""

    def __init__(self, things: Iterator[Any]) -> None:
        self._things = things
        self.seconds = 0.0

    def __iter__(self) -> Iterator[Any]:
        return self

    def __next__(self) -> Any:
        begin = time.perf_counter()
        try:
            return next(self._things)
        finally:
            self.seconds += time.perf_counter() - begin


def _sync(file: Path) -> None:
    with file.open("rb+") as stream:
        os.fsync(stream.fileno())


def _size(folder: Path) -> int:
    return sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
