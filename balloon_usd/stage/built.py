"""What a finished build tells the writer."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path


@dataclass(frozen=True)
class Built:
    """An asset that is whole but not yet published."""

    files: tuple[Path, ...]
    """Files relative to the built path; the first one is the one to open."""
    stale: tuple[str, ...] = ()
    """Earlier details that were left out."""
