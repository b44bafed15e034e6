"""`gather`: several bubbles folded to and fro, and all their ends twisted together at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.operations.closing import ClosesOnItself
from balloon_usd.operations.loop import short_loops
from balloon_usd.operations.operation import BubbleKind, Lengths

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.operations.caution import Caution
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench


class Gather(ClosesOnItself):
    """Fold a balloon to and fro and twist all layers at once: each bubble becomes a petal of one flower."""

    word: ClassVar[str] = "gather"
    bubble_kind: ClassVar[BubbleKind | None] = "petal"
    hollow: ClassVar[bool] = True
    spreads: ClassVar[bool] = True
    example: ClassVar[str] = """\
format: 1
name: flower
units: cm
balloons:
  main: {size: 260, color: yellow, length: 36, tail: 8}
steps:
  - gather: {petal_1: 18, petal_2: 18, petal_3: 18, petal_4: 18, petal_5: 18}
    burp: 20 %
  - rest: stem
"""
    sources: ClassVar[tuple[str, ...]] = (
        "mossieur-ballon.com, 14 and 18: six petals in one twist, and both wings of a butterfly",
        "professorwonder.com, balloon 40",
        "howcast.com: the paper-clip fold",
    )

    gather: Lengths
    """Make bubbles of these lengths, fold them to and fro, and twist all their ends together at once."""

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Make its bubbles, at least two."""
        super().check(value, place, bench)
        if isinstance(value, dict) and len(value) == 1:
            what = f"{next(iter(value))} is a single petal"
            bench.complain((*place.path, cls.word), f"{what}, expected loop, or at least two")

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of petals that are too short to be bent."""
        yield from short_loops(self.word, self.gather, index, layout)

    def perform(self, score: Score, index: int) -> None:
        """Twist the bubbles off, bring the two ends of each together, and twist all into one."""
        for bubble in self.gather:
            score.twist(bubble, self.turns, index)
        rings: list[int] = []
        for bubble in self.gather:
            start, end = score.layout.ends(bubble)
            if end is not None:
                score.gather(start, end, self.point, f"{self.word}: {bubble}", index)
                rings += [start, end]
        if rings:
            score.weld(tuple(dict.fromkeys(rings)), self.turns, self.label, index)
