"""Turns: threads that work with Warp one at a time, while the graphs of the others run.

Warp records one graph at a time in a process, and records what any thread launches meanwhile. So a thread
works with Warp only in its turn, and gives the turn away while a recorded graph runs on the CPU, which takes
nearly all of the time.
"""

from __future__ import annotations

import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

_turn = threading.Lock()
_mine = threading.local()


@contextmanager
def turn() -> Iterator[None]:
    """Wait for this thread's turn and keep it for the block."""
    with _turn:
        _mine.held = True
        try:
            yield
        finally:
            _mine.held = False


@contextmanager
def turn_given_away() -> Iterator[None]:
    """Let others have the turn during the block, if this thread has it."""
    if not getattr(_mine, "held", False):
        yield
        return
    _turn.release()
    try:
        yield
    finally:
        _turn.acquire()
