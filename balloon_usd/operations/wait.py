"""`wait`: the hands do nothing."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from balloon_usd.operations.modifiers import Seconds
from balloon_usd.operations.moves import Move
from balloon_usd.operations.operation import Operation

if TYPE_CHECKING:
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.score import Score


class Wait(Operation):
    """Do nothing for some seconds."""

    word: ClassVar[str] = "wait"
    called: ClassVar[tuple[str, ...]] = ("hold", "pause")
    whole: ClassVar[bool] = True
    on_rounds: ClassVar[bool] = True
    keeps_time: ClassVar[bool] = True
    example: ClassVar[str] = """\
format: 1
name: held
units: cm
balloons:
  main: {size: 260, color: red, length: 13, tail: 6}
steps:
  - bubbles: {head: 7, neck: 5}
  - wait: 1.5
  - rest: body
must_hold: planned
"""
    sources: ClassVar[tuple[str, ...]] = (
        "howstuffworks.com: first and last bubbles are held until a lock closes",
        "sharonministries.org.za: Balloons 2",
    )

    wait: Seconds
    """Do nothing for some seconds."""

    @classmethod
    def value_of(cls, units: Units, /, seconds: float) -> object:
        """Return its value as it stands in a file."""
        return seconds

    @property
    def label(self) -> str:
        """The step in a few words."""
        return f"wait: {self.wait:g} s"

    def perform(self, score: Score, index: int) -> None:
        """Let time go by."""
        score.add(Move(score.now, self.wait, index, "wait"))
