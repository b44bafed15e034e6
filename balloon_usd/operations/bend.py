"""`bend`: bubbles bent by an angle, which they keep a part of."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import Field

from balloon_usd.language.choices import all_of
from balloon_usd.language.lengths import at_least, cm
from balloon_usd.language.names import Name
from balloon_usd.language.quantities import Angle, angle_entry
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.closing import LENIENCE, ROUND
from balloon_usd.operations.curving import Curves
from balloon_usd.operations.loop import SHORTEST
from balloon_usd.operations.moves import Bend as BendMove
from balloon_usd.operations.reach import SECONDS_PER_METRE, swung_reach

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.score import Score

BEND_SECONDS = 0.9
"""Bending one bubble, s."""
ROUND_OFF = 1e-6
"""Degrees by which an angle in radians may miss a whole number."""


class Bend(Curves):
    """Bend bubbles by an angle, their ends towards a point."""

    word: ClassVar[str] = "bend"
    example: ClassVar[str] = """\
format: 1
name: swan_neck
units: cm
balloons:
  main: {size: 260, color: yellow, length: 15, tail: 5}
steps:
  - bubbles: {head: 6, neck: 18}
  - bend: {neck: 90}
    point: up
  - rest: body
must_hold: planned
"""
    sources: ClassVar[tuple[str, ...]] = (
        "Kosaka 2008, fig. 2.2: the bend",
        "mbfloyd.com: Different twists",
        "mossieur-ballon.com, 11: air control",
    )

    bend: Annotated[dict[Name, Angle], Field(min_length=1)]
    """Bend bubbles by an angle (degrees; radians in Python), their ends towards point."""

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file."""
        return {name: angle_entry(angle) for name, angle in self.bend.items()}

    @classmethod
    def value_of(
        cls, units: Units, angles: Mapping[str, float | str] | None = None, /, **more: float | str
    ) -> object:
        """Return its value as it stands in a file: angles in degrees."""
        return {**(angles or {}), **more}

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield bends that take more turns than a bubble has length for."""
        for name, angle in self.bend.items():
            bubble = layout.bubble(name)
            most = math.tau * bubble.length / (ROUND * bubble.width)
            least = ROUND * bubble.width * angle / math.tau
            if bubble.length < least - LENIENCE:
                text = f"{_degrees(angle)} are too tight for {cm(bubble.length)} of a {bubble.size}"
                text += f", which is {cm(bubble.width)} wide, expected at most {_degrees(most)}"
                yield (self.word, name), f"{text}, or a bubble of at least {at_least(least)}"

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of bends that crease: they are as tight as a loop that is too short."""
        for name, angle in self.bend.items():
            bubble = layout.bubble(name)
            least = SHORTEST * bubble.width * angle / math.tau
            if bubble.length < least:
                yield Caution(
                    index,
                    f"{name} ({cm(bubble.length)}) is too short to be bent by {_degrees(angle)}",
                    f"a {bubble.size} is {cm(bubble.width)} wide, so its inner side creases",
                    f"make it {at_least(least)} or longer, or bend it less",
                )

    def perform(self, score: Score, index: int) -> None:
        """Lead each bubble onto an arc."""
        self._refuse_closed(score, index)
        point = score.towards(self.point or "up")
        calm = {bubble: self._calm_seconds(bubble, score, index) for bubble in self.bend}
        score.refuse_haste(index, self.seconds, sum(calm.values()), f"bend {all_of(self.names)}")
        for bubble, angle in self.bend.items():
            rings, flat = self.rings_along(score.layout, bubble)
            seconds = calm[bubble] / score.pace.leading
            again = any(isinstance(move, BendMove) and move.rings == rings for move in score.moves)
            move = BendMove(score.now, seconds, index, f"bend: {bubble}", rings, point, flat, again, angle)
            score.add(move)
            score.let_go(index)

    def _refuse_closed(self, score: Score, index: int) -> None:
        """Refuse bubbles that close on themselves: both their ends are one joint."""
        piece = score.piece.after(index)
        closed = [name for name in self.names if piece.is_closed((name,))]
        text = "closes on itself, and has no ends that could be led, expected another bubble, or aim"
        if closed:
            score.refuse(index, {(self.word, name): f"{name} {text}" for name in closed})

    def _calm_seconds(self, bubble: str, score: Score, index: int) -> float:
        """Return how long a calm maker takes to bend a bubble, with what hangs on it, s."""
        half_turns = self.bend[bubble] / math.pi
        return max(BEND_SECONDS, half_turns * SECONDS_PER_METRE * swung_reach(score, bubble, index))


def _degrees(angle: float) -> str:
    """Return an angle (rad) in whole degrees, rounded down: `90 degrees`."""
    return f"{math.floor(math.degrees(angle) + ROUND_OFF)} degrees"
