"""What the measurements ran on, in words."""

from __future__ import annotations

import os
import platform
from pathlib import Path

import warp as wp

PROCESSORS = Path("/proc/cpuinfo")
"""Where Linux tells the name of the processor."""


def cores() -> int:
    """Return the processor cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def machine(device: str) -> str:
    """Return a device with its name, and the cores of the processor beside it."""
    count = cores()
    noun = "core" if count == 1 else "cores"
    if wp.get_device(device).is_cuda:
        return f"{device} ({wp.get_device(device).name}; {count} {noun} of {_processor()})"
    return f"{device} ({_processor()}, {count} {noun})"


def _processor() -> str:
    if PROCESSORS.is_file():
        for line in PROCESSORS.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()
