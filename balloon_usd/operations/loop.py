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
name: ring
units: cm
balloons:
  main: {size: 260, color: yellow, tail: 20}
steps:
  - bubbles: {stem: 8}
  - loop: {petal: 24}
  - rest: tail
"""

    loop: Lengths
    """Make a long bubble and twist its two ends together."""
