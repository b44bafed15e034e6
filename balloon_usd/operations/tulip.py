"""`tulip`: the knot is pressed through the first bubble and twisted into its other end."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.lengths import at_least, at_most, cm
from balloon_usd.language.problem import quoted
from balloon_usd.operations.modifiers import Turned
from balloon_usd.operations.moves import Invert
from balloon_usd.operations.operation import BubbleKind, Lengths, TwistsOff

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.operations.score import Layout, Score
    from balloon_usd.operations.workbench import Place, Workbench

LONGEST = 1.5
"""Length of the longest tulip, in diameters of its tube: in simulations of a 260 the wall that is turned
inside one of 7.5 cm stays taut; in one of 9 it is slack, and the bubble flutters about it.
"""
SHORTEST = 0.7
"""The same of the shortest one: the wall of one of 3 cm folds aside, its knot stays before it."""
INVERT_SECONDS = 2.0
"""Time in which a finger presses the knot through, s."""


class Tulip(Turned, TwistsOff):
    """Press the knot through the first bubble and twist it into its other end."""

    word: ClassVar[str] = "tulip"
    bubble_kind: ClassVar[BubbleKind | None] = "tulip"
    closes: ClassVar[bool] = True
    inverts: ClassVar[bool] = True
    gas: ClassVar[float] = 0.8
    slack: ClassVar[float] = 1.2
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
            made = bench.piece.bubbles.get(name)
            if made is None or made.step != place.index or bench.piece.row(made.balloon)[0] == name:
                continue
            first = bench.piece.row(made.balloon)[0]
            what = f"{quoted(name)} is not the first bubble of {quoted(made.balloon)}, {quoted(first)} is"
            path = (*place.path, cls.word, name)
            bench.complain(path, f"{what}: expected the bubble at the knot, which is pressed through it")

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield bubbles that are too short for the knot, or too long to be held taut by what is inside."""
        for name, length in self.tulip.items():
            bubble = layout.bubble(name)
            what, fault = f"{cm(length)} of a {bubble.size}", None
            if length < (least := SHORTEST * bubble.width):
                fault = f"{what} are too short for a tulip, the knot has no room in it"
                fault += f", expected {at_least(least)} or more, or ear"
            elif length > (most := LONGEST * bubble.width):
                fault = f"{what} are too long for a tulip, what is turned inside is slack"
                fault += f", expected {at_most(most)} or less"
            if fault is not None:
                yield (self.word, name), fault

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
