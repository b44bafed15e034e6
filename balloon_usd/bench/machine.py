"""What the measurements ran on, in words."""

from __future__ import annotations

import math
import os
import platform
from pathlib import Path

import warp as wp

STATUS = Path("/proc/self/status")
"""Where Linux tells what a process takes; `getrusage` counts what its parent took, too."""
KIBI = 1024.0
"""Bytes of the unit that it is told in."""
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


def peak_memory() -> float:
    """Return the most memory that this process has taken so far (B); no number where that is not told."""
    if STATUS.is_file():
        for line in STATUS.read_text(encoding="utf-8").splitlines():
            if line.startswith("VmHWM:"):
                return KIBI * float(line.split()[1])
    return math.nan


def _processor() -> str:
    if PROCESSORS.is_file():
        for line in PROCESSORS.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()
