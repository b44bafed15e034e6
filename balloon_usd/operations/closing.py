"""Operations that twist the two ends of a bubble together: of one that they make, or that is there."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import BeforeValidator, Discriminator, Field, Tag

from balloon_usd.language.joint import ends_of
from balloon_usd.language.lengths import at_least, cm
from balloon_usd.language.names import Name, listed, shortest
from balloon_usd.language.problem import quoted
from balloon_usd.operations.modifiers import Pointed, Turned
from balloon_usd.operations.operation import Lengths, TwistsOff

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.language.problem import Path
    from balloon_usd.language.quantities import LengthLike, Units
    from balloon_usd.operations.layout import Layout, PlacedBubble
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench

ROUND = 0.9
"""Length of the longest ball, in diameters of its tube: a shorter bubble is wider than long, and has no side
that could be laid round a hole or along another.
"""
LENIENCE = 1e-6
"""Length that may lack without being missed, m."""


def too_round(bubble: PlacedBubble, word: str) -> str | None:
    """Return why the two ends of a bubble cannot be brought round to each other; None where they can.

    `word`: the operation that shall do that.
    """
    if bubble.of_round:
        return f"part of a {bubble.size}, a round balloon with no side to bend, expected joints of others"
    least = ROUND * bubble.width
    if bubble.length > least - LENIENCE:
        return None
    text = f"{cm(bubble.length)} of a {bubble.size} make a ball, wider than long, with no side to bend"
    return f"{text}, expected ear instead of {word}, or at least {at_least(least)}"


class ClosesOnItself(Pointed, Turned, TwistsOff):
    """An operation that makes bubbles each of which closes on itself."""

    closes: ClassVar[bool] = True
    of_balls: ClassVar[bool] = False
    """Whether hands squeeze the two ends of a ball together through it, and need no length to bend."""

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield bubbles that are too short to be bent at all."""
        for name in () if self.of_balls else self.names:
            if (told := too_round(layout.bubble(name), self.word)) is not None:
                yield self.path_of(name), told


NEW, THERE = "lengths of new bubbles", "bubbles that are there"
"""Tags of what is closed, which never occur as keys of a recipe."""


def _form(value: object) -> str:
    return THERE if isinstance(value, (str, list, tuple)) else NEW


LengthsOrNames = Annotated[
    Annotated[Lengths, Tag(NEW)]
    | Annotated[
        tuple[Name, ...],
        Field(min_length=1),
        BeforeValidator(listed, json_schema_input_type=Name | tuple[Name, ...]),
        Tag(THERE),
    ],
    Discriminator(_form),
]
"""Bubbles that are closed: lengths of new ones, or names of those that are there."""


class TwistsClosed(ClosesOnItself):
    """An operation that closes one bubble after another, each with a twist of its own: new ones, or those
    that an earlier step made.
    """

    pulled: ClassVar[float] = 0.0
    """How far hands pull its bubbles out between their ends, in diameters of their tubes."""

    @property
    def lengths(self) -> dict[str, float]:
        """Bubbles that it twists off: inflated length (m) by name."""
        found: dict[str, float] | tuple[str, ...] = getattr(self, self.word)
        return found if isinstance(found, dict) else {}

    @property
    def names(self) -> tuple[str, ...]:
        """Bubbles that it closes."""
        return tuple(getattr(self, self.word))

    @property
    def closed(self) -> tuple[str, ...]:
        """Bubbles that it closes."""
        return self.names

    @property
    def does(self) -> str:
        """What hands do with joints, in a word."""
        return "closes"

    def path_of(self, bubble: str) -> tuple[str, ...]:
        """Return the keys under which a bubble stands."""
        return super().path_of(bubble) if bubble in self.lengths else (self.word,)

    def entry(self, units: str | None) -> object:
        """Return its value as it stands in a file."""
        return super().entry(units) if self.lengths else shortest(self.names)

    @classmethod
    def value_of(
        cls,
        units: Units,
        lengths: Mapping[str, LengthLike] | Sequence[str] | str | None = None,
        /,
        **more: LengthLike,
    ) -> object:
        """Return its value as it stands in a file.

        Raises:
            TypeError: it names bubbles that are there beside lengths of new ones.
        """
        if lengths is None or isinstance(lengths, Mapping):
            return super().value_of(units, lengths, **more)
        if more:
            raise TypeError(f"{cls.word}: names bubbles beside lengths of new ones, expected one of both")
        return lengths if isinstance(lengths, str) else shortest(lengths)

    @classmethod
    def uses(cls, value: object) -> tuple[str, ...]:
        """Return the bubbles that are there, which it closes."""
        named = listed(value) if _form(value) == THERE else ()
        assert isinstance(named, (list, tuple)), "what is no list of names is read as lengths"
        return tuple(name for name in named if isinstance(name, str))

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Make its bubbles, or find those that are there, and close each."""
        super().check(value, place, bench)
        for name in cls.uses(value):
            cls._close(name, (*place.path, cls.word), bench)

    @classmethod
    def _close(cls, name: str, path: Path, bench: Workbench) -> None:
        if not bench.has_name(name, path) or not bench.find_firm(name, path) or not bench.knows((name,)):
            return
        if bench.piece.bubbles[name].last:
            what = f"{quoted(name)} is what is left of its balloon, whose tip is no joint"
            bench.complain(path, f"{what}, expected tie: {{end: {name}.end, to: {name}.start}}")
            return
        bench.join(path, ends_of(name), tuple(map(str, ends_of(name))))

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield bubbles that are too short to be bent at all, and gas pressed out of those that are there."""
        yield from super().refusals(layout)
        if self.burp is not None and not self.lengths:
            what = "presses gas out before a bubble is twisted off"
            yield ("burp",), f"{what}, expected it where {self.names[0]} is made"

    def perform(self, score: Score, index: int) -> None:
        """Twist each bubble off that is not there, bring its two ends together and twist them into one."""
        for bubble in self.names:
            if bubble in self.lengths:
                score.twist(bubble, self.turns, index)
            start, end = score.twistable(ends_of(bubble), self.word, index)
            text = f"{self.word} twist: {bubble}"
            pulled = self.pulled * score.layout.bubble(bubble).width
            fold = bubble if self.folds else None
            score.gather(start, end, self.point, text, index, fold=fold, pulled=pulled)
            score.weld((start, end), self.turns, text, index)
