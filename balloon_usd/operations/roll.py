"""`roll`: the three-bubble roll, which makes the body of a bird."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.names import Name
from balloon_usd.operations.modifiers import Entries
from balloon_usd.operations.passing import Passing, Ring

if TYPE_CHECKING:
    from balloon_usd.operations.workpiece import ContactKind


class RolledBubble(Entries):
    """What is rolled between what."""

    bubble: Name
    """The bubble that is rolled, about as long as the others."""
    between: Ring
    """The bubbles of a lock, at whose joint it begins; or a loop."""


class Roll(Passing):
    """Roll a bubble between the two of a lock: the three-bubble body of birds."""

    word: ClassVar[ContactKind] = "roll"
    called: ClassVar[tuple[str, ...]] = ("bird_body",)
    value_model: ClassVar[type[Entries] | None] = RolledBubble
    ring_key: ClassVar[str] = "between"
    beyond: ClassVar[float] = 0.0
    dip: ClassVar[float] = 0.7
    example: ClassVar[str] = """\
format: 1
name: bird_body
units: cm
balloons:
  main: {size: 260, color: green, length: 40, tail: 8}
steps:
  - bubbles: {head: 5, left: 12, right: 12}
  - lock: [left, right]
    point: up
  - bubbles: {belly: 11}
  - roll: {bubble: belly, between: [left, right]}
  - rest: tail
"""
    sources: ClassVar[tuple[str, ...]] = (
        "balloonhq.com: Twists 101, the three-bubble body",
        "geocities.com/EnchantedForest/Glade/5001: bird body",
        "entertainmentguide.local.com: parrot",
    )

    roll: RolledBubble
    """Roll a bubble between the two of a lock: the three-bubble body of birds."""
