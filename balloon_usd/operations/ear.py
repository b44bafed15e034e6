"""`ear`: a short soft bubble pinched sideways: a pinch twist."""

from __future__ import annotations

from typing import ClassVar

from balloon_usd.operations.closing import LengthsOrNames, TwistsClosed
from balloon_usd.operations.operation import BubbleKind


class Ear(TwistsClosed):
    """Pinch a short soft bubble and twist its two ends together."""

    word: ClassVar[str] = "ear"
    called: ClassVar[tuple[str, ...]] = ("pinch", "pinch_twist", "ear_twist", "bean", "petal")
    bubble_kind: ClassVar[BubbleKind | None] = "ear"
    pulled: ClassVar[float] = 0.9
    of_balls: ClassVar[bool] = True
    gas: ClassVar[float] = 0.85
    slack: ClassVar[float] = 1.4
    example: ClassVar[str] = """\
format: 1
name: bear_head
units: cm
balloons:
  main: {size: 260, color: brown, length: 15.5, tail: 7.5}
steps:
  - bubbles: {left_cheek: 8}
  - ear: {left_ear: 4}
  - bubbles: {forehead: 6}
  - ear: {right_ear: 4}
  - bubbles: {right_cheek: 8}
  - lock: {joints: [left_cheek.start, right_cheek.end]}
    point: up
  - rest: neck
"""
    sources: ClassVar[tuple[str, ...]] = (
        "geocities.com/EnchantedForest/Glade/5001: the ear twist",
        "mbfloyd.com: Different twists, the pinch twist",
        "bpmizuki.hatenablog.jp: 空豆ひねり",
    )

    ear: LengthsOrNames
    """Pinch a short soft bubble and twist its two ends together."""
