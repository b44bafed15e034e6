"""The lock round graph capture: one thread at a time launches kernels, while the graphs of the others run.

Warp captures one graph at a time in a process, and captures what any thread launches meanwhile. So a thread
calls Warp only with this lock, and releases it while a captured graph runs on the CPU, which takes nearly all
of the time.
"""

from __future__ import annotations

import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

_lock = threading.Lock()
_this_thread = threading.local()


@contextmanager
def capture_lock() -> Iterator[None]:
    """Hold the lock for the block."""
    with _lock:
        _this_thread.held = True
        try:
            yield
        finally:
            _this_thread.held = False


@contextmanager
def capture_lock_released() -> Iterator[None]:
    """Release the lock during the block, if this thread holds it."""
    if not getattr(_this_thread, "held", False):
        yield
        return
    _lock.release()
    try:
        yield
    finally:
        _lock.acquire()
