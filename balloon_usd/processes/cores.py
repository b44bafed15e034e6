"""Cores of the CPU."""

from __future__ import annotations

import os


def usable_cores() -> int:
    """Return how many cores of the CPU this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1
