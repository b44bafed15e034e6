"""One golden stage: its recipe, how much of it, and what may differ."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.diff import EXACT, Tolerances

if TYPE_CHECKING:
    from pathlib import Path


@dataclass(frozen=True)
class GoldenEntry:
    """What the list says of one stage."""

    recipe: Path
    frames: int | None = None
    """The first so many frames are kept; None: all."""
    tolerances: Tolerances = EXACT
