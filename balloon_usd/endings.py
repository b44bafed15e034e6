"""Signals that end a process as exceptions do, so that it tidies up: Ctrl-C, SIGTERM and SIGHUP."""

from __future__ import annotations

import signal
import sys
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

AGAIN = 0.02
"""Time after which what was dropped is raised once more (s)."""
TERMINATING = tuple(
    number for name in ("SIGTERM", "SIGHUP") if (number := getattr(signal, name, None)) is not None
)
"""Signals by which others end a process: on purpose, or by closing its terminal."""
ENDINGS = frozenset((signal.SIGINT, *TERMINATING))
"""Signals that ask a process to end."""


class Terminated(BaseException):
    """Ends a process that is sent SIGTERM or SIGHUP as Ctrl-C does, so that it tidies up."""


def terminate(*_: object) -> None:
    """Handle such a signal: raise `Terminated`. A second one must not cut short what tidies up."""
    for number in TERMINATING:
        signal.signal(number, signal.SIG_IGN)
    raise Terminated


@contextmanager
def never_dropped(*endings: type[BaseException]) -> Iterator[None]:
    """Let exceptions that signal handlers raise end the block also where Python drops exceptions.

    In finalizers, and in what libraries call, an exception is told on the error stream and goes no further:
    the process would go on as if nobody had asked it to end. Such a one is raised once more, soon after.
    """
    before = sys.unraisablehook

    def raise_again(_number: int, _frame: FrameType | None) -> None:
        raise dropped[-1]

    def hook(unraisable: sys.UnraisableHookArgs) -> None:
        if not issubclass(unraisable.exc_type, endings) or not hasattr(signal, "setitimer"):
            before(unraisable)
            return
        dropped.append(unraisable.exc_type)
        signal.signal(signal.SIGALRM, raise_again)
        signal.setitimer(signal.ITIMER_REAL, AGAIN)

    dropped: list[type[BaseException]] = []
    sys.unraisablehook = hook
    try:
        yield
    finally:
        if dropped:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
        sys.unraisablehook = before


@contextmanager
def endings_wait() -> Iterator[None]:
    """Let signals that end the process by exceptions wait for the end of the block."""
    if threading.current_thread() is not threading.main_thread():
        # Handlers of signals run in the main thread.
        yield
        return
    came: list[int] = []
    # Blocking a signal would not do: then another thread of the process takes it.
    before = {number: signal.getsignal(number) for number in ENDINGS}
    raising = {number: handler for number, handler in before.items() if callable(handler)}
    for number in raising:
        signal.signal(number, lambda number, _: came.append(number))
    try:
        yield
    finally:
        for number, handler in raising.items():
            signal.signal(number, handler)
        for number in came:
            signal.raise_signal(number)
