"""`squeeze`: two hands press a bubble flat, and let it go."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar

from balloon_usd.language.names import Name
from balloon_usd.language.quantities import PercentWithin
from balloon_usd.operations.modifiers import Entries
from balloon_usd.operations.moves import Press
from balloon_usd.operations.pressing import Pressing

if TYPE_CHECKING:
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.score import Score

SQUEEZE_SECONDS = 1.5
"""Squeezing, holding and letting go, s."""


class SqueezedBubble(Entries):
    """What hands squeeze, and how far."""

    bubble: Name
    """The bubble that is squeezed."""
    by: Annotated[float, PercentWithin(1.0, 60.0)]
    """By how much of its width the hands come nearer to each other; percent."""


class Squeeze(Pressing):
    """Squeeze a bubble between both hands, and let it go: a firm one yields little."""

    word: ClassVar[str] = "squeeze"
    on_rounds: ClassVar[bool] = True
    value_model: ClassVar[type[Entries] | None] = SqueezedBubble
    example: ClassVar[str] = """\
format: 1
name: squeezed
units: cm
balloons:
  main: {size: 260, color: blue, length: 15, tail: 5}
steps:
  - bubbles: {soft: 7}
    burp: 30 %
  - squeeze: {bubble: soft, by: 40 %}
    point: down
must_hold: planned
"""
    sources: ClassVar[tuple[str, ...]] = (
        "Kosaka 2008, 4.2.2: a force from above; here from both sides",
        "balloonhq.com, FAQ, twists 101: last air squeezed into a ball at the end",
    )

    squeeze: SqueezedBubble
    """Squeeze a bubble between both hands, and let it go."""

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file."""
        return {"bubble": self.bubble, "by": f"{self.squeeze.by:g} %"}

    @classmethod
    def value_of(cls, units: Units, /, bubble: str, *, by: float | str) -> object:
        """Return its value as it stands in a file: by how much of its width, percent."""
        return {"bubble": bubble, "by": by}

    def perform(self, score: Score, index: int) -> None:
        """Press the palms of both hands on its middle, while fingers hold its ends."""
        bubble = score.layout.bubble(self.bubble)
        move = Press(
            score.now,
            SQUEEZE_SECONDS if self.seconds is None else self.seconds,
            index,
            self.label,
            balloon=bubble.balloon,
            along=bubble.rest_place(0.5 * bubble.length),
            point=score.towards(self.point or "down"),
            depth=0.01 * self.squeeze.by * bubble.width,
            holds=tuple(ring for ring in score.layout.ends(self.bubble) if ring is not None),
            flat=True,
        )
        self.press_and_let_go(score, move)
