"""What can go wrong while a stage is written."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Tf

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


class StageError(Exception):
    """A stage cannot be written; the message is one line that says why."""


@contextmanager
def writing(target: Path) -> Iterator[None]:
    """Report a failed write inside the block as a `StageError` about `target`.

    Raises:
        StageError: The disk is full, the folder cannot be written, a file is in the way.
    """
    try:
        yield
    except OSError as error:
        raise StageError(f"{target} could not be written: {error.strerror or error}") from error
    except Tf.ErrorException as error:
        raise StageError(f"{target} could not be written: {_reason(error)}") from error


def _reason(error: Any) -> str:
    """First cause that USD gives, on one line."""
    first = str(error.args[0].commentary).removeprefix("Error occurred writing file: ")
    return " ".join(first.split())
