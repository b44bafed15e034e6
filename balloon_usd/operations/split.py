"""`split`: an ear whose two cheeks are twisted against each other: a split ear, two toes, a yo-yo."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.operations.closing import ClosesOnItself
from balloon_usd.operations.ear import Ear
from balloon_usd.operations.moves import Halve
from balloon_usd.operations.operation import BubbleKind, Lengths
from balloon_usd.operations.score import PINCH_SECONDS

if TYPE_CHECKING:
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench

HALVES = 2


class Split(ClosesOnItself):
    """Make an ear of both lengths and twist its two cheeks against each other: two balls on one joint."""

    word: ClassVar[str] = "split"
    called: ClassVar[tuple[str, ...]] = ("split_ear", "toes", "yo_yo")
    bubble_kind: ClassVar[BubbleKind | None] = "half"
    of_balls: ClassVar[bool] = True
    gas: ClassVar[float] = Ear.gas
    slack: ClassVar[float] = Ear.slack
    example: ClassVar[str] = """\
format: 1
name: hoof
units: cm
balloons:
  main: {size: 260, color: brown, length: 14, tail: 8}
steps:
  - bubbles: {leg: 9}
  - split: {left_toe: 3.5, right_toe: 3.5}
    point: down
  - rest: heel
"""
    sources: ClassVar[tuple[str, ...]] = (
        "geocities.com/EnchantedForest/Glade/5001: the split ear twist",
        "balloonhq.com: Twists 101, the split ear",
    )

    split: Lengths
    """Make an ear of two bubbles of these lengths, and twist its cheeks against each other."""

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Make its bubbles, which are two."""
        super().check(value, place, bench)
        if isinstance(value, dict) and value and len(value) != HALVES:
            what = f"{len(value)} bubbles, expected the two halves of one ear"
            bench.complain((*place.path, cls.word), what)

    def perform(self, score: Score, index: int) -> None:
        """Twist both off as one ear, then pinch that between its cheeks and bring the pinch to its joint."""
        first, second = self.split
        start, middle = score.layout.ends(first)
        end = score.layout.ends(second)[1]
        assert middle is not None, "a half of an ear is followed by the other"
        assert end is not None, "what is left of a balloon is no half of an ear"
        text, width = f"ear twist: {first}, {second}", score.layout.bubble(first).width
        score.twist(second, self.turns, index, pinches=HALVES)
        score.gather(start, end, self.point, text, index, pulled=Ear.pulled * width)
        score.weld((start, end), self.turns, text, index)
        seconds = PINCH_SECONDS / score.pace.leading
        score.add(Halve(score.now, seconds, index, f"pinch: {first}, {second}", ring=middle))
        score.gather(middle, end, self.point, self.label, index, pulled=Ear.pulled * width)
        score.weld((middle, end), self.turns, self.label, index)
