"""What operations share in which hands press on one bubble, and let it go."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.operations.modifiers import OnBalloon, Pointed, Timed
from balloon_usd.operations.moves import Move
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.score import SETTLE_SECONDS

if TYPE_CHECKING:
    from balloon_usd.operations.moves import Press
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench


class Pressing(OnBalloon, Pointed, Timed, Operation):
    """An operation whose value names the bubble on which hands press."""

    keeps_time: ClassVar[bool] = True

    @property
    def bubble(self) -> str:
        """The bubble that is pressed."""
        named: str = getattr(self, self.word).bubble
        return named

    @property
    def names(self) -> tuple[str, ...]:
        """The bubble that is pressed."""
        return (self.bubble,)

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubble that is pressed."""
        bubble = value.get("bubble") if isinstance(value, dict) else None
        return (bubble,) if isinstance(bubble, str) else ()

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Complain of a bubble that does not exist by now."""
        for bubble in cls.uses(value):
            bench.find_whole(bubble, place, (*place.path, cls.word, "bubble"))

    def press_and_let_go(self, score: Score, move: Press) -> None:
        """Press, wait until the shape has returned, and let go."""
        score.add(move)
        score.add(Move(score.now, 2.0 * SETTLE_SECONDS, move.step, move.text))
        score.let_go(move.step)
