"""Property 30: nothing half-written lies beside a stage."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.files.lock import is_held
from balloon_usd.stage.properties import Finding
from balloon_usd.stage.workspace import LOCK, SUFFIX

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


def nothing_left_over(file: Path) -> Iterator[Finding]:
    """Property 30: no hidden folder of a killed run stands beside the file, or beside its asset's folder.

    A run that is writing there now is none of it.
    """
    whole = file.absolute()
    places = [(whole.parent, whole.stem)]
    if whole.parent.name == whole.stem:
        places.append((whole.parent.parent, whole.stem))
    for beside, name in places:
        for folder in sorted(beside.glob(f".{name}.????????{SUFFIX}")):
            if not is_held(folder / LOCK):
                yield Finding(30, f"a killed run has left {folder}")
