"""How much memory a child process may take: a damaged count claims far more, which took minutes to fill."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.cli.device import start_device

if TYPE_CHECKING:
    from collections.abc import Iterable

if sys.platform != "win32":
    import resource

SHARE = 0.75
"""Share of the computer's memory that a child may fill at most."""
LEAST = 4 << 30
"""Memory that it may fill in any case [B]: libraries, pictures, and stages of some megabytes."""
FOR_A_CORE = 64 << 20
"""Memory for each core besides [B]: libraries have a thread on it, with a stack."""
TIMES_AS_MUCH = 100
"""Memory for a byte of a stage [B]: samples are compressed, and NVIDIA's validator holds all of a layer."""

MOST_FILES = 10_000
"""Files of a folder that are looked at: it may be no stage at all."""


def memory_for(stage_bytes: int) -> int:
    """Return how much memory [B] stages of so many bytes may take."""
    computer = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    libraries = LEAST + FOR_A_CORE * (os.cpu_count() or 1)
    return min(int(SHARE * computer), libraries + TIMES_AS_MUCH * stage_bytes)


def bytes_there(stages: Iterable[str]) -> int:
    """Return how large files and folders are [B]; what is not there has none."""
    return sum(_size(file) for stage in stages for file in (Path(stage), *_below(Path(stage))))


def bytes_composed(stages: Iterable[str]) -> int:
    """Return how large all files are that stages are composed of [B]."""
    from balloon_usd.openusd import UsdUtils  # noqa: PLC0415
    from balloon_usd.stage.on_disk import file_of  # noqa: PLC0415
    from balloon_usd.stage.opening import quiet  # noqa: PLC0415

    with quiet():
        found = [UsdUtils.ComputeAllDependencies(str(file_of(Path(stage)))) for stage in stages]
    layers = {layer.realPath for layers, _, _ in found for layer in layers}
    return sum(_size(Path(layer)) for layer in layers)


def limit_memory(most: int) -> None:
    """Refuse this process more memory than so much [B], beside what it has."""
    if sys.platform != "linux":
        return
    # Address space without memory behind it, which CUDA reserves, is not counted.
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[5])
    hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
    wanted = os.sysconf("SC_PAGE_SIZE") * pages + most
    resource.setrlimit(resource.RLIMIT_DATA, (wanted if hard < 0 else min(wanted, hard), hard))


def start_drawing(device: str) -> str:
    """Start Warp and return the name of the device; a CUDA device takes what memory its driver wants.

    Raises:
        Failure: as `start_device` says.
    """
    if sys.platform != "linux":
        return start_device(device)
    soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (hard, hard))
    used = start_device(device)
    if used == "cpu":
        resource.setrlimit(resource.RLIMIT_DATA, (soft, hard))
    return used


def _size(file: Path) -> int:
    with suppress(OSError, ValueError):
        return file.stat().st_size
    return 0


def _below(folder: Path) -> list[Path]:
    with suppress(OSError, ValueError):
        return [*islice(folder.rglob("*"), MOST_FILES)] if folder.is_dir() else []
    return []
