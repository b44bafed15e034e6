"""The output folder: refused before anything is computed for it."""

from __future__ import annotations

import tempfile
from typing import TYPE_CHECKING

from balloon_usd.cli.failure import ExitCode, Failure

if TYPE_CHECKING:
    from pathlib import Path


def require_writable(folder: Path) -> None:
    """Make the folder if need be and try to write in it.

    Raises:
        Failure: that is not possible, or its name is none that USD can read.
    """
    require_readable_name(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise Failure(
            f"{folder}: cannot write here ({error.strerror or error})", ExitCode.BAD_INPUT
        ) from error


def require_readable_name(path: Path) -> None:
    """Refuse a path by which USD can open no file.

    Raises:
        Failure: bytes of the path are not UTF-8, or control characters.
    """
    from balloon_usd.stage.on_disk import why_not_named  # noqa: PLC0415

    if why := why_not_named(path):
        raise Failure(why, ExitCode.BAD_INPUT)
