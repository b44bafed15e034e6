"""`bubbles`: twist off one bubble after another, the basic twist of every figure."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.operations.modifiers import Turned
from balloon_usd.operations.operation import BubbleKind, Lengths, TwistsOff

if TYPE_CHECKING:
    from balloon_usd.operations.score import Score


class Bubbles(Turned, TwistsOff):
    """Twist off bubbles of these lengths, one after another."""

    word: ClassVar[str] = "bubbles"
    called: ClassVar[tuple[str, ...]] = ("twist", "bubble", "sausage", "basic_twist")
    on_rounds: ClassVar[bool] = True
    on_hearts: ClassVar[bool] = False
    bubble_kind: ClassVar[BubbleKind | None] = "bubble"
    example: ClassVar[str] = """\
format: 1
name: caterpillar
units: cm
balloons:
  main: {size: 260, color: green, length: 14, tail: 6}
steps:
  - bubbles: {head: 6, first: 4, second: 4, third: 4}
  - rest: tail
must_hold: planned
"""
    sources: ClassVar[tuple[str, ...]] = (
        "Kosaka 2008, fig. 2.2: the bubble twist",
        "balloonhq.com: Twists 101, the basic twist",
        "allaboutclowns.com: Twisting lingo",
    )

    bubbles: Lengths
    """Twist off bubbles of these lengths, one after another."""

    def perform(self, score: Score, index: int) -> None:
        """Pinch and turn at the end of each bubble."""
        for bubble in self.bubbles:
            score.twist(bubble, self.turns, index)
