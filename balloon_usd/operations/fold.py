"""`fold`: a bubble bent in its middle, both halves side by side."""

from __future__ import annotations

from typing import ClassVar

from balloon_usd.operations.closing import TwistsClosed
from balloon_usd.operations.operation import BubbleKind, Lengths


class Fold(TwistsClosed):
    """As loop, but bent sharply in its middle so that both halves lie side by side."""

    word: ClassVar[str] = "fold"
    bubble_kind: ClassVar[BubbleKind | None] = "fold"
    example: ClassVar[str] = """\
format: 1
name: folded
units: cm
balloons:
  main: {size: 260, color: white, tail: 20}
steps:
  - bubbles: {stem: 8}
  - fold: {ear: 16}
  - rest: tail
"""

    fold: Lengths
    """As loop, but bent sharply in its middle so that both halves lie side by side."""
