"""Operations that make a bubble and twist its own two ends together."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.lengths import at_least, cm
from balloon_usd.operations.modifiers import Pointed, Turned
from balloon_usd.operations.operation import TwistsOff

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.operations.score import Layout, PlacedBubble, Score

ROUND = 0.9
"""Length of the longest ball, in diameters of its tube: a shorter bubble is wider than long, and has no side
that could be laid round a hole or along another.
"""
LENIENCE = 1e-6
"""Length that may lack without being missed, m."""


def too_round(bubble: PlacedBubble, word: str) -> str | None:
    """Return why the two ends of a bubble cannot be brought round to each other; None where they can.

    `word`: the operation that shall do that.
    """
    if bubble.of_round:
        return f"part of a {bubble.size}, a round balloon with no side to bend, expected joints of others"
    least = ROUND * bubble.width
    if bubble.length > least - LENIENCE:
        return None
    text = f"{cm(bubble.length)} of a {bubble.size} make a ball, wider than long, with no side to bend"
    return f"{text}, expected ear instead of {word}, or at least {at_least(least)}"


class ClosesOnItself(Pointed, Turned, TwistsOff):
    """An operation that makes bubbles each of which closes on itself."""

    closes: ClassVar[bool] = True
    of_balls: ClassVar[bool] = False
    """Whether hands squeeze the two ends of a ball together through it, and need no length to bend."""

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield bubbles that are too short to be bent at all."""
        for name in () if self.of_balls else self.lengths:
            if (told := too_round(layout.bubble(name), self.word)) is not None:
                yield (self.word, name), told


class TwistsClosed(ClosesOnItself):
    """An operation that closes one bubble after another, each with a twist of its own."""

    pulled: ClassVar[float] = 0.0
    """How far hands pull its bubbles out between their ends, in diameters of their tubes."""

    def perform(self, score: Score, index: int) -> None:
        """Twist each bubble off, bring its two ends together and twist them into one."""
        for bubble in self.lengths:
            score.twist(bubble, self.turns, index)
            start, end = score.layout.ends(bubble)
            if end is not None:
                text = f"{self.word} twist: {bubble}"
                pulled = self.pulled * score.layout.bubble(bubble).width
                fold = bubble if self.folds else None
                score.gather(start, end, self.point, text, index, fold=fold, pulled=pulled)
                score.weld((start, end), self.turns, text, index)
