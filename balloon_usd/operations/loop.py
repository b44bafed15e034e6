"""`loop`: a long bubble whose two ends meet, such as a petal or a wing."""

from __future__ import annotations

from typing import ClassVar

from balloon_usd.operations.closing import TwistsClosed
from balloon_usd.operations.operation import BubbleKind, Lengths


class Loop(TwistsClosed):
    """Make a long bubble and twist its two ends together."""

    word: ClassVar[str] = "loop"
    bubble_kind: ClassVar[BubbleKind | None] = "loop"
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

    loop: Lengths
    """Make a long bubble and twist its two ends together."""
