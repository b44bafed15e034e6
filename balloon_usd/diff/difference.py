"""A difference between two stages: where, since when, how much."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from balloon_usd.diff.movement import Movement

ONLY = ("only in the first stage", "only in the second stage")


@dataclass(frozen=True)
class Spread:
    """The time codes at which two values differ."""

    worst: float
    """Time code of the largest difference, the first of several."""
    first: float
    last: float
    count: int
    """How many time codes differ."""
    compared: int
    """How many were compared."""

    def __str__(self) -> str:
        """Format as in `at 31 of 480 time codes, first at 190`."""
        if self.count == 1:
            return f"at 1 of {self.compared} time codes"
        return f"at {self.count} of {self.compared} time codes, first at {self.first:g}"


@dataclass(frozen=True)
class Difference:
    """One sentence about one prim or property, over all time codes."""

    prim: str
    """Path of the prim; empty for the stage itself."""
    text: str
    """What differs, without the place."""
    name: str = ""
    """Name of the property, empty where the prim itself or all of its surface is meant."""
    by: float | None = None
    """Largest difference in the attribute's unit; None where that means nothing."""
    spread: Spread | None = None
    """Time codes that differ; None for what does not depend on time."""
    movement: Movement | None = None
    """How far a surface or one of its bubbles lies from where it lay; None for all other differences."""
    selection: str = ""
    """Variants under which it shows, empty for those that the stages select themselves."""

    @property
    def place(self) -> str:
        """Path of the prim or property, with the selection of variants; empty for the stage itself."""
        where = f"{self.prim}.{self.name}" if self.name else self.prim
        return f"[{self.selection}] {where}".rstrip() if self.selection else where

    def __str__(self) -> str:
        """One sentence with its place."""
        return f"{self.place}: {self.text}" if self.place else self.text
