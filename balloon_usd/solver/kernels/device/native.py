"""Functions in C++ and CUDA, for what Warp has no word for."""

from collections.abc import Callable
from typing import TypeVar, cast

import warp as wp

Stub = TypeVar("Stub")


def native(snippet: str) -> Callable[[Stub], Stub]:
    """Return the decorator that gives a stub its snippet and keeps the stub's type."""
    return cast("Callable[[Stub], Stub]", wp.func_native(snippet))
