"""`pop`: a bubble is burst between two joints that hold, and tears."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.language.names import Name
from balloon_usd.operations import moves
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.score import SETTLE_SECONDS

if TYPE_CHECKING:
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench

POP_SECONDS = 0.125
"""Time in which its gas is gone, s: three frames at 24 a second, so that the burst is seen."""
SNAP_SECONDS = 1.0
"""Time in which its rubber snaps back and its neighbours come to rest, s."""


class Pop(Operation):
    """Burst a bubble: it tears, and its rubber snaps back to its joints, which ears or locks keep shut."""

    word: ClassVar[str] = "pop"
    called: ClassVar[tuple[str, ...]] = ("burst", "prick", "pop_twist")
    keeps_time: ClassVar[bool] = True
    example: ClassVar[str] = """\
format: 1
name: popped
units: cm
balloons:
  main: {size: 260, color: pink, length: 17, tail: 6.5}
steps:
  - bubbles: {before: 7}
  - ear: {first: 3}
  - bubbles: {gap: 5}
  - ear: {second: 3}
  - rest: beyond
  - pop: gap
"""
    sources: ClassVar[tuple[str, ...]] = (
        "geocities.com/EnchantedForest/Glade/5001: popping a bubble",
        "gomanoyakata.moto-nari.com: cutting between sealed bubbles",
    )

    pop: Name
    """Burst a bubble: it tears, and its rubber snaps back to its joints, which ears or locks keep shut."""

    @property
    def names(self) -> tuple[str, ...]:
        """The bubble that bursts."""
        return (self.pop,)

    @classmethod
    def value_of(cls, units: Units, /, bubble: str) -> object:
        """Return its value as it stands in a file."""
        return bubble

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubble that bursts."""
        return (value,) if isinstance(value, str) else ()

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Burst a bubble that is there, whole, and shut off from its neighbours for good."""
        for bubble in cls.uses(value):
            bench.pop(bubble, (*place.path, cls.word))

    def perform(self, score: Score, index: int) -> None:
        """Prick it, and wait while its rubber snaps back."""
        score.add(moves.Pop(score.now, POP_SECONDS, index, self.label, bubble=self.pop))
        score.add(moves.Move(score.now, SNAP_SECONDS + SETTLE_SECONDS, index, self.label))
        score.let_go(index)
