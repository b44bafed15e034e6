"""Cautions: what a maker would warn of before taking the balloon in hand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

UNEQUAL = 0.10
"""Difference that shows of the lengths of what ends in the same joints, as a share of the longest."""


@dataclass(frozen=True)
class Caution:
    """A warning with its reason."""

    step: int | None
    """Index of the step it is about; None for the sculpture as a whole."""
    what: str
    why: str
    remedy: str


def unequal(lengths: Sequence[float]) -> bool:
    """Say whether bubbles of some lengths (m) that end in the same joints are so unequal that it shows."""
    return max(lengths) - min(lengths) > UNEQUAL * max(lengths)
