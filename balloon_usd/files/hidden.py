"""Hidden files and folders among many others."""

from __future__ import annotations

import os
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path


def matching(folder: Path, start: str, *patterns: str) -> list[Path]:
    """Return what in a folder begins with `start` and has the form of a pattern, in the order of names.

    Folders of batches hold thousands of names: this takes two thirds of the time of a glob.

    Raises:
        OSError: the folder cannot be read.
    """
    names = [name for name in os.listdir(folder) if name.startswith(start)]  # noqa: PTH208
    return [folder / name for name in sorted(names) if any(fnmatchcase(name, form) for form in patterns)]
