"""Writing files whole or not at all."""

from __future__ import annotations

import secrets
import sys
from contextlib import ExitStack, suppress
from typing import TYPE_CHECKING

from balloon_usd.files.lock import hold

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

PARTIAL = ".partial"
"""Ending of a file that has not got its final name yet."""


def write_whole(contents: Mapping[Path, bytes]) -> None:
    """Write files beside their final names, then give all of them those: no half-written one is ever seen.

    What a killed process leaves is `.NAME.????????.partial`, whose lock nobody holds.

    Raises:
        OSError: a file cannot be written, as on a full disk; its `filename` is the final name.
    """
    # Names of their own, since another run may write the same files.
    mark = secrets.token_hex(4)
    partial = {path: path.with_name(f".{path.name}.{mark}{PARTIAL}") for path in contents}
    path = next(iter(contents))
    with ExitStack() as stack:
        try:
            for path, content in contents.items():
                stack.callback(_remove, partial[path])
                held = stack.enter_context(hold(partial[path]))
                held.write(content)
                held.flush()
                if sys.platform == "win32":
                    # What is open there cannot get another name.
                    held.close()
            for path in contents:
                partial[path].replace(path)
        except OSError as error:
            error.filename, error.filename2 = str(path), None
            raise


def _remove(partial: Path) -> None:
    with suppress(OSError):
        partial.unlink(missing_ok=True)
