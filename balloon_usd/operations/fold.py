"""`fold`: a bubble bent in its middle, both halves side by side."""

from __future__ import annotations

from typing import ClassVar

from balloon_usd.operations.closing import LengthsOrNames, TwistsClosed
from balloon_usd.operations.operation import BubbleKind


class Fold(TwistsClosed):
    """As loop, but bent sharply in its middle so that both halves lie side by side."""

    word: ClassVar[str] = "fold"
    called: ClassVar[tuple[str, ...]] = ("fold_twist",)
    bubble_kind: ClassVar[BubbleKind | None] = "fold"
    hollow: ClassVar[bool] = True
    folds: ClassVar[bool] = True
    guides: ClassVar[tuple[float, ...]] = (0.25, 0.5, 0.75)
    example: ClassVar[str] = """\
format: 1
name: sword
units: cm
balloons:
  main: {size: 260, color: orange, length: 27, tail: 7}
steps:
  - bubbles: {grip: 7}
  - fold: {left_guard: 20}
    point: left
  - fold: {right_guard: 20}
    point: right
  - rest: blade
"""
    sources: ClassVar[tuple[str, ...]] = (
        "allaboutclowns.com: Twisting lingo, the fold twist",
        "airweaver.wordpress.com",
    )

    fold: LengthsOrNames
    """As loop, but bent sharply in its middle so that both halves lie side by side."""
