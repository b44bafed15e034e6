"""Operations that make a bubble and twist its own two ends together."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.operations.modifiers import Pointed, Turned
from balloon_usd.operations.operation import TwistsOff

if TYPE_CHECKING:
    from balloon_usd.operations.score import Score


class TwistsClosed(Pointed, Turned, TwistsOff):
    """An operation that makes bubbles each of which closes on itself."""

    closes: ClassVar[bool] = True
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
