"""Cores of the CPU."""

from __future__ import annotations

import math
import os
from pathlib import Path

CONTROL_GROUP = Path("/sys/fs/cgroup")
"""Where Linux tells what a container may use: in cpu.max (version 2), or in two files of cpu (version 1)."""


def usable_cores() -> int:
    """Return how many cores of the CPU this process may use: those it is bound to, and no more than what the
    processor time of its container comes to.
    """
    affinity = getattr(os, "sched_getaffinity", None)
    cores = len(affinity(0)) if affinity else os.cpu_count() or 1
    quota = cores_of_container()
    return cores if quota is None else max(min(cores, quota), 1)


def cores_of_container() -> int | None:
    """Return how many cores the processor time of a container comes to, rounded up; None without a limit."""
    for files in (("cpu.max",), ("cpu/cpu.cfs_quota_us", "cpu/cpu.cfs_period_us")):
        try:
            quota, period = " ".join((CONTROL_GROUP / file).read_text("ascii") for file in files).split()
            # Without a limit the quota is "max", or -1.
            return math.ceil(int(quota) / int(period)) if int(quota) > 0 else None
        except (OSError, ValueError, ZeroDivisionError):
            continue
    return None
