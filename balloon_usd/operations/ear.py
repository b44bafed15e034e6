"""`ear`: a short soft bubble pinched sideways: a pinch twist."""

from __future__ import annotations

from typing import ClassVar

from balloon_usd.operations.closing import TwistsClosed
from balloon_usd.operations.operation import BubbleKind, Lengths


class Ear(TwistsClosed):
    """Pinch a short soft bubble and twist its two ends together."""

    word: ClassVar[str] = "ear"
    bubble_kind: ClassVar[BubbleKind | None] = "ear"
    example: ClassVar[str] = """\
format: 1
name: eared
units: cm
balloons:
  main: {size: 260, color: pink, tail: 20}
steps:
  - bubbles: {stem: 8}
  - ear: {knob: 4}
  - rest: tail
"""

    ear: Lengths
    """Pinch a short soft bubble and twist its two ends together."""
