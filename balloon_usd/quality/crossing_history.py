"""The crossings of a figure over time."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from balloon_usd.quality.pierced_walls import Crossings, Pair


class CrossingHistory:
    """Keeps the crossings of the frames in which they were counted."""

    def __init__(self) -> None:
        """Begin with nothing counted."""
        self.frames: dict[int, Crossings] = {}
        """By time code, in order."""

    def add(self, time_code: int, found: Crossings) -> None:
        """Take the crossings of a later frame."""
        self.frames[time_code] = found

    @property
    def worst(self) -> int:
        """Time code of the first of the frames with most crossings."""
        return max(self.frames, key=lambda code: self.frames[code].count)

    def facts(self, last: int) -> dict[str, int]:
        """Return how many there are in the last frame, of a time code: the same with and without a report."""
        return {"crossings": self.frames[last].count} if last in self.frames else {}

    def pairs(self) -> list[Pair]:
        """Return the bubbles that cross, those first that cross most in any one frame."""
        most: Counter[Pair] = Counter()
        for found in self.frames.values():
            most |= Counter(found.pairs)
        return [pair for pair, _ in most.most_common()]

    def counts_of(self, pair: Pair) -> list[int]:
        """Return how often two bubbles cross in each of the frames."""
        return [found.pairs.get(pair, 0) for found in self.frames.values()]


def pair_text(pair: Pair) -> str:
    """Return two bubbles that cross, for people."""
    return f"{pair[0]} with itself" if pair[0] == pair[1] else f"{pair[0]} and {pair[1]}"
