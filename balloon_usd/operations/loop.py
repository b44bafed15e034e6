"""`loop`: a long bubble whose two ends meet, such as a petal or a wing."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.lengths import at_least, cm
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.closing import LengthsOrNames, TwistsClosed
from balloon_usd.operations.operation import BubbleKind

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from balloon_usd.operations.layout import Layout

SHORTEST = 2.0
"""Length of the shortest loop, in diameters of its tube: the ends of a shorter one meet before it bends."""


class Loop(TwistsClosed):
    """Make a long bubble and twist its two ends together."""

    word: ClassVar[str] = "loop"
    called: ClassVar[tuple[str, ...]] = ("hoop", "loop_twist")
    bubble_kind: ClassVar[BubbleKind | None] = "loop"
    hollow: ClassVar[bool] = True
    guides: ClassVar[tuple[float, ...]] = tuple(k / 8 for k in range(1, 8))
    example: ClassVar[str] = """\
format: 1
name: dragonfly
units: cm
balloons:
  main: {size: 260, color: blue, length: 27, tail: 7}
steps:
  - bubbles: {head: 5}
  - loop: {left_wing: 24}
    point: left
  - loop: {right_wing: 24}
    point: right
  - rest: body
"""
    sources: ClassVar[tuple[str, ...]] = (
        "Kosaka 2008, fig. 2.2: the loop twist",
        "geocities.com/EnchantedForest/Glade/5001: the loop twist",
        "bpmizuki.hatenablog.jp: 輪ひねり",
    )

    loop: LengthsOrNames
    """Make a long bubble and twist its two ends together."""

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of loops that are too short to be bent."""
        yield from short_loops(self.word, self.names, index, layout)


def short_loops(word: str, names: Iterable[str], index: int, layout: Layout) -> Iterator[Caution]:
    """Yield a caution for each bubble that is too short to be bent round by a step of this word and index."""
    for name in names:
        bubble = layout.bubble(name)
        least = SHORTEST * bubble.width
        if bubble.length < least:
            yield Caution(
                index,
                f"{name} ({cm(bubble.length)}) is too short for a {word}",
                f"a {bubble.size} is {cm(bubble.width)} wide, so its ends meet before it bends",
                f"ear instead of {word}, or at least {at_least(least)}",
            )
