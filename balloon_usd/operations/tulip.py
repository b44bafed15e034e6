"""`tulip`: the knot is pressed through the first bubble and twisted into its other end."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.operations.inverting import INVERT_SECONDS, InvertsBubble
from balloon_usd.operations.moves import Invert
from balloon_usd.operations.operation import Lengths, TwistsOff

if TYPE_CHECKING:
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench


class Tulip(InvertsBubble, TwistsOff):
    """Press the knot through the first bubble and twist it into its other end."""

    word: ClassVar[str] = "tulip"
    called: ClassVar[tuple[str, ...]] = ("apple", "apple_twist", "tulip_twist")
    gas: ClassVar[float] = 0.8
    example: ClassVar[str] = """\
format: 1
name: tulip
units: cm
balloons:
  main: {size: 260, color: red, length: 16, tail: 6}
steps:
  - tulip: {flower: 7}
  - rest: stem
"""
    sources: ClassVar[tuple[str, ...]] = (
        "allaboutclowns.com: Twisting lingo, the tulip twist and the apple twist",
        "balloonotherapy.blogspot.com 2013-02: the tulip",
        "balloonhq.com: Twists 101",
    )

    tulip: Lengths
    """Press the knot through the first bubble and twist it into its other end."""

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Make its bubble, the first one of its balloon."""
        super().check(value, place, bench)
        for name in cls.makes(value):
            cls.check_first(name, (*place.path, cls.word, name), place, bench)

    def perform(self, score: Score, index: int) -> None:
        """Twist the bubble off, press the knot through it and twist both ends into one."""
        begin = score.now
        for name in self.lengths:
            score.twist(name, self.turns, index)
            start, end = score.layout.ends(name)
            assert end is not None, "what is left of a balloon is no tulip"
            text, seconds = f"tulip: {name}", INVERT_SECONDS / score.pace.leading
            score.add(Invert(score.now, seconds, index, text, knot=start, to=end))
            score.weld((start, end), self.turns, text, index)
        score.refuse_haste(index, self.seconds, score.now - begin, "press a knot through")
