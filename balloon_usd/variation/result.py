"""What became of the variations of a recipe."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from balloon_usd.recipe import Notice, Problem


@dataclass(frozen=True)
class Variation:
    """A recipe that was written."""

    name: str
    file: Path
    values: Mapping[str, object]
    """What was set, by its path in the recipe."""


@dataclass(frozen=True)
class LeftOut:
    """A variation that the reader or the plan refuses."""

    name: str
    values: Mapping[str, object]
    problem: Problem
    """The first one; its place is in a text that was not written."""


@dataclass(frozen=True)
class Variations:
    """All variations of a recipe, in the order in which they were made."""

    written: tuple[Variation, ...]
    left_out: tuple[LeftOut, ...]
    notices: tuple[Notice, ...] = ()
    """What the writer of the recipe should know, such as words in it that have new names."""
