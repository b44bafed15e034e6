"""Ending with the process that started this one."""

from __future__ import annotations

import ctypes
import os
import sys
from contextlib import suppress

PR_SET_PDEATHSIG = 1
"""Of `prctl` on Linux: the signal that a process gets when the one that started it is gone."""


def end_with(parent: int, number: int) -> None:
    """Let the system send this process a signal when its parent is gone, also within a long call."""
    if sys.platform != "linux":
        return
    with suppress(AttributeError, OSError):
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, number)
    if os.getppid() != parent:
        os._exit(0)
