"""`curl`: bubbles rolled up into coils, of which they keep nearly all."""

from __future__ import annotations

import math
from numbers import Real
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
from balloon_usd.operations.curving import Curves
from balloon_usd.operations.score import SETTLE_SECONDS

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.language.quantities import Units
    from balloon_usd.operations.layout import Layout, PlacedBubble
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench
    from balloon_usd.operations.workpiece import Workpiece

LEAST_TURNS = 0.5
"""Turns below which nothing is a coil."""
PITCH = 1.15
"""How far a coil goes on along its axis with each turn, or a disc outwards, in widths of the tube: walls that
touch lie a tenth of that farther apart in the coarsest mesh.
"""
NARROWEST = 0.6
"""Radius of the narrowest coil, and of a disc within, in the same: walls touch each other across its axis."""
TIGHTEST = math.hypot(math.tau * NARROWEST, PITCH)
"""Length of the tightest turn, in the same."""
KEPT = 0.92
"""Share of their turns that coils keep when hands let go: 0.87 to 0.98 of a 160, 0.81 to 0.89 of a 260, the
tighter the less.
"""
PLACES_A_TURN = 8
"""At how many places hands hold a bubble for each turn."""
ROLLING_SPEED = 0.1
"""Speed at which a coil rolls along its bubble, m/s."""
LEAST_SECONDS = 1.5
"""Shortest curling of a bubble, s."""


class Curl(Curves):
    """Roll bubbles up into coils, from their free ends."""

    word: ClassVar[str] = "curl"
    called: ClassVar[tuple[str, ...]] = ("coil",)
    once: ClassVar[bool] = True
    example: ClassVar[str] = """\
format: 1
name: snake
units: cm
balloons:
  main: {size: 160, color: green, inflated: 80}
steps:
  - bubbles: {head: 4}
  - ear: {left_eye: 2}
    point: left
  - ear: {right_eye: 2}
    point: right
  - rest: body
  - curl: {body: 3}
    point: down
"""
    sources: ClassVar[tuple[str, ...]] = (
        "professorwonder.com, balloon 2: a tail wound round a finger",
        "mossieur-ballon.com, 11: air control",
    )

    curl: Annotated[dict[Name, Annotated[float, Between(-10.0, 10.0, "turns")]], Field(min_length=1)]
    """Roll bubbles up into so many turns, right-handed or, below 0, left-handed, along an axis to point."""
    disc: bool = False
    """Roll each turn round the last one, as of a snail's shell, in place of beside it."""

    @classmethod
    def value_of(cls, units: Units, turns: Mapping[str, float] | None = None, /, **more: float) -> object:
        """Return its value as it stands in a file: turns by bubble."""
        # Numbers of NumPy, too.
        given: dict[str, object] = {**(turns or {}), **more}
        return {name: float(each) if isinstance(each, Real) else each for name, each in given.items()}

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Roll up bubbles that are there and have a free end."""
        super().check(value, place, bench)
        for name in cls.uses(value):
            if bench.knows((name,)) and name not in bench.piece.bridges():
                what = f"both ends of {name} hang on one figure"
                bench.complain((*place.path, cls.word, name), f"{what}, expected a bubble with a free end")

    def held_at(self, piece: Workpiece) -> dict[str, int]:
        """Return at how many places hands hold each bubble: of a disc as closely as its inner end needs."""
        turn = math.tau * NARROWEST if self.disc else TIGHTEST
        rolled = {name: self._least(abs(turns) / KEPT) / turn for name, turns in self.curl.items()}
        return {name: math.ceil(PLACES_A_TURN * each) + 1 for name, each in rolled.items()}

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield what is no coil, and coils of more turns than a bubble has length for."""
        for name, turns in self.curl.items():
            bubble = layout.bubble(name)
            most = self._room(bubble)
            if abs(turns) < LEAST_TURNS:
                text = f"{turns:g} turns are no coil"
                yield (self.word, name), f"{text}, expected bend, or at least {LEAST_TURNS:g} turns"
            elif abs(turns) > most:
                text = f"{cm(bubble.length)} of a {bubble.size} are too short for {turns_text(turns)}"
                least = at_least(self._least(abs(turns)) * bubble.width)
                yield (self.word, name), f"{text}, expected at most {most_turns(most)}, or {least}"

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of coils that open, since there is no length to roll them farther than they shall stay."""
        for name, turns in self.curl.items():
            bubble = layout.bubble(name)
            most = self._room(bubble)
            if KEPT * most < abs(turns) <= most:
                least = at_least(self._least(abs(turns) / KEPT) * bubble.width)
                yield Caution(
                    index,
                    f"{name} is rolled up as tight as can be, and opens to fewer than {turns_text(turns)}",
                    f"{cm(bubble.length)} of a {bubble.size} have no room for more, of which a part is lost",
                    f"make it {least}, or at most {most_turns(KEPT * most)} turns",
                )

    def perform(self, score: Score, index: int) -> None:
        """Roll each bubble up, farther than it shall stay where there is length for that."""
        lengths = {name: score.layout.bubble(name).length for name in self.curl}
        calm = {name: max(LEAST_SECONDS, length / ROLLING_SPEED) for name, length in lengths.items()}
        waits = SETTLE_SECONDS * len(calm)
        score.refuse_haste(index, self.seconds, sum(calm.values()) + waits, f"curl {all_of(self.names)}")
        self._refuse_hanging(score, index)
        for name, asked in self.curl.items():
            rings, flat = self.rings_along(score.layout, name)
            bubble = score.layout.bubble(name)
            turns = math.copysign(min(abs(asked) / KEPT, self._room(bubble)), asked)
            text = f"{self.word}: {name}"
            move = moves.Curl(
                score.now,
                calm[name] / score.pace.leading,
                index,
                text,
                rings=rings,
                point=score.sided(moves.FRONTS[self.point or "up"]),
                flat=flat,
                turns=-turns if score.mirrored else turns,
                asked=abs(asked),
                rise=0.0 if self.disc else PITCH * bubble.width,
                growth=PITCH * bubble.width if self.disc else 0.0,
            )
            score.settle(move)

    def _refuse_hanging(self, score: Score, index: int) -> None:
        """Refuse discs with something on both ends: there is no room for it within."""
        if not self.disc:
            return
        piece = score.piece.after(index)
        hanging = [name for name in self.names if not any(map(piece.is_free, ends_of(name)))]
        text = "something hangs on both ends, expected a free end from which a disc is rolled up, or no disc"
        if hanging:
            score.refuse(index, {(self.word, name): text for name in hanging})

    def _least(self, turns: float) -> float:
        """Return the length of the tightest coil or disc of so many turns, in widths of the tube."""
        return math.pi * turns * (2.0 * NARROWEST + PITCH * turns) if self.disc else TIGHTEST * turns

    def _room(self, bubble: PlacedBubble) -> float:
        """Return how many turns there is length for in a bubble."""
        widths = bubble.length / bubble.width
        if self.disc:
            return (math.sqrt(NARROWEST**2 + PITCH * widths / math.pi) - NARROWEST) / PITCH
        return widths / TIGHTEST
