"""What killed runs leave beside the stages: hidden folders and files that never got their final names."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

from balloon_usd.files.hidden import matching
from balloon_usd.files.lock import locked, remove_unheld
from balloon_usd.stage.workspace import sweep

if TYPE_CHECKING:
    from pathlib import Path

PARTIAL = ("png", "report.png", "report.json")
"""Endings of files that are written beside their final names."""


def remove_leftovers(folder: Path, name: str) -> None:
    """Remove what killed runs of a sculpture left in a folder, and nothing of a run that lives."""
    # There is nothing to remove where there is no folder.
    with suppress(FileNotFoundError):
        sweep(name, folder)
        forms = [f".{name}.{ending}.????????.partial" for ending in PARTIAL]
        if found := matching(folder, *forms):
            with locked(folder):
                for partial in found:
                    remove_unheld(partial)
