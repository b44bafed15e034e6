"""`push`: an end of a balloon is pushed through a closed ring of bubbles, which holds it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.choices import all_of
from balloon_usd.language.lengths import cm
from balloon_usd.language.names import Name
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.modifiers import Entries
from balloon_usd.operations.passing import Passing, Ring, depth_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.workpiece import ContactKind

SMALL = 5.5
"""Way round a ring beyond which a ball slips out of it, in lengths of the ball: one of 3 cm stays in a loop
of 15 cm, and slips out of one of 20.
"""


class PushedBubble(Entries):
    """What is pushed through what."""

    bubble: Name
    """The bubble that is pushed: an end of a balloon, beside the ring."""
    through: Ring
    """The bubbles of the ring: one that closes on itself, or those of a lock."""


class Push(Passing):
    """Push a bubble at the end of a balloon through a closed ring of others, which holds it."""

    word: ClassVar[ContactKind] = "push"
    called: ClassVar[tuple[str, ...]] = ("push_through", "pop_through")
    on_rounds: ClassVar[bool] = True
    value_model: ClassVar[type[Entries] | None] = PushedBubble
    ring_key: ClassVar[str] = "through"
    beyond: ClassVar[float] = math.radians(40.0)
    example: ClassVar[str] = """\
format: 1
name: face
units: cm
balloons:
  main: {size: 260, color: orange, length: 26, tail: 12}
steps:
  - bubbles: {nose: 6, left_ear: 7, right_ear: 7}
  - lock: [left_ear, right_ear]
    point: up
  - push: {bubble: nose, through: [left_ear, right_ear]}
  - rest: neck
"""
    sources: ClassVar[tuple[str, ...]] = (
        "bpmizuki.hatenablog.jp, 14: bubble roll-through",
        "balloonotherapy.blogspot.com: teddy bear",
        "swordfishadvertising.co.uk: giraffe",
    )

    push: PushedBubble
    """Push a bubble at the end of a balloon through a closed ring of others, which holds it."""

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of a bubble that gets stuck in its ring, and of a ball that slips out of it."""
        yield from super().cautions(index, layout)
        bubble, depth = layout.bubble(self.bubble), depth_of(layout, self.ring)
        ring = all_of(self.ring)
        if bubble.length <= bubble.width and 2.0 * depth > SMALL * bubble.length:
            yield Caution(
                index,
                f"{self.bubble} ({cm(bubble.length)}) may slip out of {ring}",
                f"the way round the ring is {cm(2.0 * depth)}, and its hole as wide as the ball",
                f"make the ball at least {cm(2.0 * depth / SMALL)} long, or the ring smaller",
            )
