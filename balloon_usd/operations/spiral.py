"""`spiral`: bubbles side by side are wound round each other."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import Field

from balloon_usd.language.choices import all_of
from balloon_usd.language.joint import Joint
from balloon_usd.language.lengths import at_least, cm
from balloon_usd.language.names import Name
from balloon_usd.language.quantities import Between
from balloon_usd.operations import moves
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.modifiers import Entries, Timed
from balloon_usd.operations.moves import Move
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.score import SETTLE_SECONDS

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.language.problem import Path
    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.score import Layout, PlacedBubble, Score
    from balloon_usd.operations.workbench import Place, Workbench

MOST_STRANDS = 6
"""Bubbles that are wound round each other at most: about more of them there is a hole as wide as two."""
EASY = 1.4
"""Length from which on bubbles are wound without creases, in the least that has room."""
PLACES_A_TURN = 6.0
"""At how many places hands hold each strand for a turn of it."""
TURN_SECONDS = 2.5
"""Time of a turn: the walls go round at 0.1 m/s, s."""
LEAST_SECONDS = 1.5
"""Shortest winding, s."""


class WoundBubbles(Entries):
    """What is wound round each other, and how far."""

    bubbles: Annotated[tuple[Name, ...], Field(min_length=1, max_length=MOST_STRANDS)]
    """Bubbles between the same two joints, or one that closes on itself, whose halves are wound."""
    turns: Annotated[float, Between(0.5, 10.0, "turns")] = 1.0
    """Full turns of one joint against the other, right-handed; left-handed in a mirrored recipe."""


class Spiral(Timed, Operation):
    """Wind bubbles that lie side by side round each other."""

    word: ClassVar[str] = "spiral"
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
    def names(self) -> tuple[str, ...]:
        """Bubbles that are wound."""
        return self.spiral.bubbles

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
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubbles that it winds."""
        named = value.get("bubbles") if isinstance(value, dict) else None
        if not isinstance(named, (list, tuple)):
            return ()
        return tuple(name for name in named[:MOST_STRANDS] if isinstance(name, str))

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Wind bubbles that are there, have their gas, and lie side by side."""
        path: Path = (*place.path, cls.word, "bubbles")
        names = cls.uses(value)
        found = [
            bench.has_name(name, (*path, k)) and bench.find_firm(name, (*path, k))
            for k, name in enumerate(names)
        ]
        if names and all(found) and bench.knows(names):
            _check_ends(names, path, bench)

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield more turns than there is length for."""
        strand, bubble = self._shortest(layout)
        least = self.spiral.turns * tightest_turn(self.strands) * bubble.width
        if strand < least:
            most = math.floor(20.0 * self.spiral.turns * strand / least) / 20.0
            text = f"{cm(strand)} of {self.strands} strands of a {bubble.size} are too short for"
            text += f" {self.spiral.turns:g} turns, expected at most {most:g}, or {at_least(least)}"
            yield (self.word, "turns"), text

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of bubbles that are wound as tight as they can be."""
        strand, bubble = self._shortest(layout)
        least = self.spiral.turns * tightest_turn(self.strands) * bubble.width
        if least <= strand < EASY * least:
            yield Caution(
                index,
                f"{all_of(self.names)} are wound tight",
                f"{self.strands} strands of {cm(strand)} take {self.spiral.turns:g} turns with creases only",
                f"make each {at_least(EASY * least)}, or wind them less",
            )

    def _shortest(self, layout: Layout) -> tuple[float, PlacedBubble]:
        """Return the length of the shortest strand, m, and the widest bubble."""
        bubbles = [layout.bubble(name) for name in self.names]
        shortest = min(bubble.length for bubble in bubbles) * len(bubbles) / self.strands
        return shortest, max(bubbles, key=lambda bubble: bubble.width)

    def perform(self, score: Score, index: int) -> None:
        """Turn the joint at one end about the way from the one at the other."""
        turns = -self.spiral.turns if score.mirrored else self.spiral.turns
        calm = max(LEAST_SECONDS, TURN_SECONDS * self.spiral.turns)
        score.refuse_haste(index, self.seconds, calm + SETTLE_SECONDS, f"wind {all_of(self.names)}")
        text = f"{self.word}: {all_of(self.names)}"
        widest = max(score.layout.bubble(name).width for name in self.names)
        move = moves.WindRound(
            score.now,
            calm / score.pace.leading,
            index,
            text,
            bubbles=self.names,
            strands=_strands(self.names, score),
            turns=turns,
            radius=widest * wound_radius(self.strands),
        )
        score.add(move)
        score.add(Move(score.now, SETTLE_SECONDS, index, text))
        score.let_go(index)


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


def _check_ends(names: Sequence[str], path: Path, bench: Workbench) -> None:
    """Complain unless bubbles end in the same two joints, or one closes on itself."""
    piece = bench.piece
    if len(set(names)) < len(names):
        bench.complain(path, "names a bubble twice, expected each once")
        return
    first = {piece.joint(Joint(names[0], end)) for end in ("start", "end")}
    if len(names) == 1:
        if not piece.is_closed(names):
            what = f"{names[0]} is no loop with two halves to wind"
            bench.complain(path, f"{what}, expected a loop, or two bubbles that a lock has laid side by side")
        return
    for name in names[1:]:
        ends = {piece.joint(Joint(name, end)) for end in ("start", "end")}
        if len(first) < 2 or ends != first:
            what = f"{names[0]} and {name} do not begin and end in the same two joints"
            bench.complain(path, f"{what}, expected bubbles that a lock has laid side by side")
            return


def _strands(names: Sequence[str], score: Score) -> tuple[tuple[int, ...], ...]:
    """Return the rings of every strand, from the joint at one end of all to that at the other."""
    rows = []
    for name in names:
        start, end = score.layout.ends(name)
        assert end is not None, "what ends at a tip ends in no joint with others"
        rows.append((start, *score.layout.guides(name), end))
    if len(rows) == 1:
        middle = len(rows[0]) // 2
        return rows[0][: middle + 1], rows[0][middle:][::-1]
    begin = score.joints.root(rows[0][0])
    return tuple(row if score.joints.root(row[0]) == begin else row[::-1] for row in rows)
