"""`spiral`: bubbles side by side are wound round each other."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import Field

from balloon_usd.language.choices import all_of
from balloon_usd.language.joint import ends_of
from balloon_usd.language.lengths import at_least, cm
from balloon_usd.language.names import Name
from balloon_usd.language.quantities import Between
from balloon_usd.language.turns import most_turns, turns_text
from balloon_usd.operations import moves
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.modifiers import Entries
from balloon_usd.operations.score import SETTLE_SECONDS
from balloon_usd.operations.strands import OfStrands, from_joint

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.language.problem import Path
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Workbench

MOST_STRANDS = 6
"""Bubbles that are wound round each other at most: about more of them there is a hole as wide as two."""
EASY = 1.4
"""Length from which on bubbles are wound without creases, in the least that has room."""
FEWEST = 0.5
"""Turns that can be asked for at least."""
PLACES_A_TURN = 6.0
"""At how many places hands hold each strand for a turn of it."""
SPRING_BACK = 0.3
"""Turns that hands wind beyond those that shall stay, where there is length for them: of half a turn to three
of a 260 a quarter to a half spring back when hands let go.
"""
TIGHT = 1.15
"""Length up to which bubbles that are wound farther keep less, in the least that has room."""
TURN_SECONDS = 2.5
"""Time of a turn: the walls go round at 0.1 m/s, s."""
LEAST_SECONDS = 1.5
"""Shortest winding, s."""


class WoundBubbles(Entries):
    """What is wound round each other, and how far."""

    bubbles: Annotated[tuple[Name, ...], Field(min_length=1, max_length=MOST_STRANDS)]
    """Bubbles between the same two joints, or one that closes on itself, whose halves are wound."""
    turns: Annotated[float, Between(FEWEST, 10.0, "turns")] = 1.0
    """Full turns of one joint against the other, right-handed; left-handed in a mirrored recipe."""


class Spiral(OfStrands):
    """Wind bubbles that lie side by side round each other."""

    word: ClassVar[str] = "spiral"
    called: ClassVar[tuple[str, ...]] = ("rope", "wind")
    most: ClassVar[int] = MOST_STRANDS
    value_model: ClassVar[type[Entries] | None] = WoundBubbles
    example: ClassVar[str] = """\
format: 1
name: candy_stick
units: cm
balloons:
  red: {size: 260, color: red, inflated: 56}
  white: {size: 260, color: white, inflated: 56}
steps:
  - bubbles: {red_end: 3}
    balloon: red
  - bubbles: {white_end: 3}
    balloon: white
  - lock: {joints: [red_end.end, white_end.end]}
  - bubbles: {red_half: 45}
    balloon: red
  - bubbles: {white_half: 45}
    balloon: white
  - lock: {joints: [red_half.end, white_half.end]}
  - spiral: {bubbles: [red_half, white_half], turns: 1.5}
"""
    sources: ClassVar[tuple[str, ...]] = (
        "clownantics.com: braids and spirals",
        "balloonhq.com, June 13: two balloons about one axis",
        "professorwonder.com, balloon 12",
    )

    spiral: WoundBubbles
    """Wind bubbles that lie side by side round each other."""

    @property
    def strands(self) -> int:
        """How many lie beside each other: a bubble that closes on itself has two halves."""
        return max(len(self.names), 2)

    @property
    def places(self) -> int:
        """At how many places hands hold each bubble, evenly."""
        of_each = math.ceil(PLACES_A_TURN * self.spiral.turns) + 1
        return of_each * self.strands // len(self.names)

    @classmethod
    def value_of(cls, units: Units, /, *bubbles: str, turns: float = 1.0) -> object:
        """Return its value as it stands in a file: bubbles side by side, and turns."""
        return {"bubbles": list(bubbles), "turns": turns}

    @classmethod
    def take(cls, names: Sequence[str], path: Path, bench: Workbench) -> None:
        """Take bubbles that end in the same two joints, or one that closes on itself."""
        piece, expected = bench.piece, "two bubbles that a lock has laid side by side"
        if len(names) == 1 and not piece.is_closed(names):
            what = f"{names[0]} is no loop with two halves to wind"
            bench.complain(path, f"{what}, expected a loop, or {expected}")
        first, *others = ({piece.joint(end) for end in ends_of(name)} for name in names)
        for name, ends in zip(names[1:], others, strict=True):
            if len(first) < 2 or ends != first:
                what = f"{names[0]} and {name} do not begin and end in the same two joints"
                bench.complain(path, f"{what}, expected {expected}")
                return
        between = {name for name in piece.bubbles if {piece.joint(end) for end in ends_of(name)} == first}
        if len(names) > 1 and (left_out := between - piece.popped - set(names)):
            what = f"{all_of(sorted(left_out))} between the same joints would be wound, too"
            bench.complain(path, f"{what}, expected all that lie there")

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield more turns than there is length for."""
        strand, least = self._strand(layout), self._least(layout)
        if strand < least:
            most = self.spiral.turns * strand / least
            fewer = f"at most {most_turns(most)}, or " if most >= FEWEST else ""
            text = f"{cm(strand)} of {self.strands} strands of a {self.widest(layout).size} are too short for"
            text += f" {turns_text(self.spiral.turns)}, expected {fewer}{at_least(least)}"
            yield (self.word, "turns"), text

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of unequal strands, and of bubbles that are wound as tight as they can be."""
        yield from super().cautions(index, layout)
        strand, least = self._strand(layout), self._least(layout)
        if least <= strand < EASY * least:
            turns = turns_text(self.spiral.turns)
            yield Caution(
                index,
                f"{all_of(self.names)} {'is' if len(self.names) == 1 else 'are'} wound tight",
                f"{self.strands} strands of {cm(strand)} take {turns} with creases only",
                f"make each {at_least(EASY * least)}, or wind them less",
            )

    def _strand(self, layout: Layout) -> float:
        """Return the length of the shortest strand, m."""
        return self.shortest(layout) * len(self.names) / self.strands

    def _least(self, layout: Layout) -> float:
        """Return the length of strands that has room for all turns, m."""
        return self.spiral.turns * tightest_turn(self.strands) * self.widest(layout).width

    def perform(self, score: Score, index: int) -> None:
        """Turn the joint at one end about the way from the one at the other."""
        turns, wound = self.spiral.turns, self._wound_before(score)
        most = self._strand(score.layout) / self._least(score.layout) * turns
        asked = wound + turns
        if wound and asked > most:
            told = f"wound {turns_text(wound)} already, and there is length for {most:.1f} in all"
            score.refuse(index, {(self.word, "turns"): f"{told}, expected fewer"})
        calm = max(LEAST_SECONDS, TURN_SECONDS * turns)
        turns += max(0.0, min(SPRING_BACK, most / TIGHT - asked))
        score.refuse_haste(index, self.seconds, calm + SETTLE_SECONDS, f"wind {all_of(self.names)}")
        text = f"{self.word}: {all_of(self.names)}"
        move = moves.WindRound(
            score.now,
            calm / score.pace.leading,
            index,
            text,
            bubbles=self.names,
            strands=self._strands(score),
            turns=-turns if score.mirrored else turns,
            asked=asked,
            radius=self.widest(score.layout).width * wound_radius(self.strands),
        )
        score.settle(move)

    def _wound_before(self, score: Score) -> float:
        """Return how often earlier steps have wound the same bubbles."""
        before = [move for move in score.moves if isinstance(move, moves.WindRound)]
        return max((move.asked for move in before if set(move.bubbles) == set(self.names)), default=0.0)

    def _strands(self, score: Score) -> tuple[tuple[int, ...], ...]:
        """Return the rings of every strand, from the joint at one end of all to the place at the other."""
        rows = self.rows(score)
        if len(rows) > 1:
            return from_joint(rows[0][0], rows, score)
        (loop,) = rows
        middle = len(loop) // 2
        return loop[: middle + 1], loop[middle:][::-1]


def tightest_turn(strands: int) -> float:
    """Return the least length of each of some tubes for a turn about each other, in their widths.

    They touch their neighbours round the axis as well as those of the turn before.
    """
    radius = wound_radius(strands)
    beside = math.tau * radius / strands
    return math.tau * radius * math.sqrt(1.0 + 1.0 / (beside * beside - 1.0))


def wound_radius(strands: int) -> float:
    """Return how far tubes that touch each other lie from the axis about which they are wound, in widths."""
    return 0.5 / math.sin(math.pi / strands)
