"""Hashes of files, by which they are known to be what they were."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path


def hashes_of(folder: Path, files: Iterable[Path]) -> dict[str, str]:
    """Return the SHA-256 of files by their paths below a folder.

    Raises:
        OSError: one cannot be read.
    """
    return {file.relative_to(folder).as_posix(): sha256_of(file) for file in files}


def are_whole(folder: Path, hashes: Mapping[str, str]) -> bool:
    """Whether all files are there, with the content that they had."""
    try:
        return all(sha256_of(folder / name) == sha256 for name, sha256 in hashes.items())
    except OSError:
        return False


def sha256_of(file: Path) -> str:
    """Return the SHA-256 of a file in hexadecimal digits; raises `OSError` when it cannot be read."""
    with file.open("rb") as opened:
        return hashlib.file_digest(opened, "sha256").hexdigest()
