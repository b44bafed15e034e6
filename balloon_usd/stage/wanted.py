"""How a stage is wanted."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Wanted:
    """What is chosen for one stage."""

    detail: str
    """Level of detail."""
    look: str
    """Look that is selected, or the only one of a stage in one file."""
    shot: bool = False
    """Whether a shot stands beside it."""
