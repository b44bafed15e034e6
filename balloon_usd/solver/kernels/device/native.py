"""Functions in the devices' own language, for what Warp has no word for."""

from collections.abc import Callable
from typing import TypeVar, cast

import warp as wp

Stub = TypeVar("Stub")


def native(snippet: str) -> Callable[[Stub], Stub]:
    """Return the decorator that gives a stub its code, with the stub's own type."""
    return cast("Callable[[Stub], Stub]", wp.func_native(snippet))
