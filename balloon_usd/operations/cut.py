"""`cut`: an end of a balloon is cut off at a joint that holds."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.names import Name
from balloon_usd.operations import moves
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.pop import POP_SECONDS, SNAP_SECONDS
from balloon_usd.operations.score import SETTLE_SECONDS

if TYPE_CHECKING:
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench


class Cut(Operation):
    """Let the gas out of an end of a balloon and cut it off, at an ear or a lock that stays shut."""

    word: ClassVar[str] = "cut"
    called: ClassVar[tuple[str, ...]] = ("deflate", "snip")
    keeps_time: ClassVar[bool] = True
    example: ClassVar[str] = """\
format: 1
name: clover
units: cm
balloons:
  main: {size: 260, color: green, length: 29, tail: 6}
steps:
  - bubbles: {stalk: 12}
  - loop: {left_leaf: 25}
    point: left
  - loop: {right_leaf: 25}
    point: right
  - rest: spare
  - cut: spare
"""
    sources: ClassVar[tuple[str, ...]] = (
        "gomanoyakata.moto-nari.com: cutting between sealed bubbles",
        "haruara18: the unused part is cut short",
    )

    cut: Name
    """Let the gas out of an end of a balloon and cut it off, at an ear or a lock that stays shut."""

    @property
    def names(self) -> tuple[str, ...]:
        """The bubble that is cut off."""
        return (self.cut,)

    @classmethod
    def value_of(cls, units: Units, /, bubble: str) -> object:
        """Return its value as it stands in a file."""
        return bubble

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubble that is cut off."""
        return (value,) if isinstance(value, str) else ()

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Cut off a bubble at an end of its balloon, which may have been popped."""
        for bubble in cls.uses(value):
            bench.cut(bubble, (*place.path, cls.word))

    def perform(self, score: Score, index: int) -> None:
        """Prick it, if no step has, wait while its rubber snaps back, and cut it off."""
        if not any(isinstance(move, moves.Pop) and move.bubble == self.cut for move in score.moves):
            score.add(moves.Pop(score.now, POP_SECONDS, index, self.label, bubble=self.cut))
            score.add(moves.Move(score.now, SNAP_SECONDS, index, self.label))
        score.add(moves.Cut(score.now, 0.0, index, self.label, bubble=self.cut))
        score.add(moves.Move(score.now, SETTLE_SECONDS, index, self.label))
        score.let_go(index)
