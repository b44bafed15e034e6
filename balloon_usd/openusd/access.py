"""A lock that lets one thread at a time work with OpenUSD."""

from __future__ import annotations

from contextlib import contextmanager
from functools import wraps
from threading import RLock
from typing import TYPE_CHECKING, ParamSpec, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

P = ParamSpec("P")
T = TypeVar("T")

_LOCK = RLock()


@contextmanager
def usd_access() -> Iterator[None]:
    """Wait until no other thread works with OpenUSD, and keep others out of it for the block.

    A block may stand within another one of the same thread. It is a decorator, too. Whoever works with `pxr`
    in threads beside this package does so in such blocks.
    """
    with _LOCK:
        yield


def each_step_alone(steps: Callable[P, Iterator[T]]) -> Callable[P, Iterator[T]]:
    """Let every step of a generator be a block of `usd_access`; what its caller does between them is not."""

    @wraps(steps)
    def guarded(*args: P.args, **kwargs: P.kwargs) -> Iterator[T]:
        running = steps(*args, **kwargs)
        while True:
            with usd_access():
                try:
                    step = next(running)
                except StopIteration:
                    return
            yield step

    return guarded
