"""What runs leave beside the stages: hidden files if they were killed, NAME.failed if a simulation failed."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

from balloon_usd.files.failed_name import failed_name
from balloon_usd.files.hidden import matching
from balloon_usd.files.lock import locked, remove_unheld
from balloon_usd.stage.workspace import discard, sweep

if TYPE_CHECKING:
    from pathlib import Path

PARTIAL = ("png", "report.png", "report.json")
"""Endings of files that are written beside their final names."""
FAILED_FILES = (".usdc", ".usdz", "_shot.usda", *(f".{ending}" for ending in PARTIAL))
"""What a simulation that failed leaves besides a folder, after the name."""


def remove_leftovers(folder: Path, name: str) -> None:
    """Remove what killed runs of a sculpture left in a folder, and nothing of a run that lives."""
    # There is nothing to remove where there is no folder.
    with suppress(FileNotFoundError):
        sweep(name, folder)
        names = (name, failed_name(name))
        forms = [f".{each}.{ending}.????????.partial" for each in names for ending in PARTIAL]
        if found := matching(folder, *forms):
            with locked(folder):
                for partial in found:
                    remove_unheld(partial)


def remove_failed(folder: Path, name: str) -> None:
    """Remove what an earlier run left of a sculpture whose simulation failed, in whatever form."""
    failed = failed_name(name)
    layered = folder / failed
    # A folder of somebody else's is left alone.
    if (layered / f"{failed}.usda").is_file() and not layered.is_symlink():
        discard(layered, name)
    for ending in FAILED_FILES:
        with suppress(OSError):
            (folder / f"{failed}{ending}").unlink()
