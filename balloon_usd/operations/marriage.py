"""`marriage`: a row of bubbles twisted side by side to those of another balloon, pair rolled through pair."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import Field

from balloon_usd.language.joint import Joint, ends_of
from balloon_usd.language.lengths import cm
from balloon_usd.language.names import Name
from balloon_usd.language.quantities import Length
from balloon_usd.operations.caution import Caution, unequal
from balloon_usd.operations.modifiers import Entries
from balloon_usd.operations.roll import Roll
from balloon_usd.operations.weaving import WeavesRow

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from balloon_usd.operations.layout import Layout
    from balloon_usd.operations.score import Score
    from balloon_usd.operations.workbench import Place, Workbench


class MarriedRow(Entries):
    """What is married to what."""

    bubbles: Annotated[dict[Name, Length], Field(min_length=2)]
    """Bubbles of the row, in order."""
    to: tuple[Name, ...] = Field(min_length=2)
    """A bubble of another balloon for each, in order along it."""


class Marriage(WeavesRow):
    """Twist bubbles side by side to those of another balloon, and roll every second into the pair before."""

    word: ClassVar[str] = "marriage"
    value_model: ClassVar[type[Entries] | None] = MarriedRow
    may_begin_joined: ClassVar[bool] = True
    example: ClassVar[str] = """\
format: 1
name: two_tone
units: cm
balloons:
  red: {size: 260, color: red, length: 14, tail: 5}
  main: {size: 260, color: white, length: 14, tail: 5}
steps:
  - bubbles: {red_1: 8, red_2: 8, red_3: 8, red_4: 8}
    balloon: red
  - marriage:
      bubbles: {white_1: 8, white_2: 8, white_3: 8, white_4: 8}
      to: [red_1, red_2, red_3, red_4]
    balloon: main
  - {rest: red_spare, balloon: red}
  - {rest: white_spare, balloon: main}
  - cut: red_spare
  - cut: white_spare
"""
    sources: ClassVar[tuple[str, ...]] = (
        "professorwonder.com, balloon 41: two balloons married",
        "twisters' lists of twists: the marriage, by name",
    )

    marriage: MarriedRow
    """Twist bubbles side by side to those of another balloon, and roll every second into the pair before."""

    @property
    def does(self) -> str:
        """What hands do with joints."""
        return "marries"

    @property
    def joints(self) -> tuple[Joint, ...]:
        """Where the first of the others begins, and where each ends."""
        return _joints_of(self.marriage.to)

    @classmethod
    def joints_in(cls, value: object) -> tuple[Joint, ...]:
        """Return the joints of the bubbles that a value names, as far as they can be read."""
        return _joints_of(cls._others(value))

    @classmethod
    def _others(cls, value: object) -> tuple[str, ...]:
        named = value.get("to") if isinstance(value, dict) else None
        whole = isinstance(named, (list, tuple)) and all(isinstance(name, str) for name in named)
        return tuple(named) if whole and named else ()

    @classmethod
    def fits(cls, value: object, place: Place, bench: Workbench) -> bool:
        """Say whether the others are as many, in a row on another balloon, and complain if they are not."""
        path, names, others = (*place.path, cls.word, "to"), cls.makes(value), cls._others(value)
        if len(names) < 2 or not bench.knows(others):
            return False
        row = bench.piece.row(bench.piece.bubbles[others[0]].balloon)
        at = row.index(others[0])
        if tuple(row[at : at + len(others)]) != others:
            bench.complain(path, f"{', '.join(others)} are no row, expected bubbles that follow each other")
        elif names[0] in row:
            bench.complain(path, f"{others[0]} is of the same balloon, expected bubbles of another")
        elif gone := [name for name in others if name in bench.piece.popped]:
            bench.complain(path, f"{gone[0]} is popped, expected bubbles that have their gas")
        elif closing := [name for name in others if bench.piece.is_closed([name])]:
            bench.complain(path, f"{closing[0]} closes on itself, expected bubbles with two ends apart")
        elif len(others) != len(names):
            bench.complain(path, f"{len(others)} bubbles for {len(names)}, expected as many")
        else:
            return True
        return False

    @classmethod
    def check(cls, value: object, place: Place, bench: Workbench) -> None:
        """Make its bubbles, let their ends become one with those of others, and roll every second."""
        known, closed = len(bench.complaints), _closed(bench)
        super().check(value, place, bench)
        names, others = cls.makes(value), cls._others(value)
        if len(bench.complaints) > known or len(names) != len(others) or not bench.knows([*names, *others]):
            return
        fault = ""
        if torn := [pair for pair in zip(names, others, strict=True) if not bench.piece.is_closed(pair)]:
            fault = f"{' and '.join(torn[0])} form no closed pair"
        elif shut := [name for name in _closed(bench) if name not in closed]:
            fault = f"{shut[0]} would be closed on itself"
        if fault:
            fault += ", for rows are joined already, expected that nowhere, or only where both begin"
            bench.complain((*place.path, cls.word, "to"), fault)
            return
        for rolled, pair in _rolled(names, others):
            bench.piece.touch(place.index, Roll.word, rolled, pair)

    @property
    def rolls(self) -> dict[str, Roll]:
        """How every second bubble is rolled between the two before it, by its name."""
        return {
            rolled: Roll.model_validate({"roll": {"bubble": rolled, "between": pair}})
            for rolled, pair in _rolled(self.lengths, self.marriage.to)
        }

    def perform(self, score: Score, index: int) -> None:
        """Twist one bubble after another off, roll every second, and twist each to its joint."""
        begin = score.now
        super().perform(score, index)
        score.refuse_haste(index, self.seconds, score.now - begin, f"marry {len(self.lengths)} bubbles")

    def lead(self, name: str, score: Score, index: int) -> None:
        """Roll every second bubble through the pair before."""
        if (roll := self.rolls.get(name)) is not None:
            roll.perform(score, index)

    def refusals(self, layout: Layout) -> Iterator[tuple[tuple[str, ...], str]]:
        """Yield bubbles that are far too long to be rolled through the pair before."""
        for name, roll in self.rolls.items():
            for _, text in roll.refusals(layout):
                yield (self.word, "bubbles", name), text

    def cautions(self, index: int, layout: Layout) -> Iterator[Caution]:
        """Warn of pairs of unequal lengths, and of what gets stuck between others."""
        for name, other in zip(self.lengths, self.marriage.to, strict=True):
            short, long = sorted(layout.bubble(each).length for each in (name, other))
            if unequal((short, long)):
                yield Caution(
                    index,
                    f"{name} and {other} are {cm(short)} and {cm(long)} long",
                    "both end in the same joints, so the longer one bows out",
                    f"make both {cm(long)} long",
                )
        for roll in self.rolls.values():
            yield from roll.cautions(index, layout)


def _closed(bench: Workbench) -> list[str]:
    """Return the bubbles that close on themselves by now."""
    return [name for name in bench.piece.bubbles if bench.piece.is_closed([name])]


def _rolled(names: Iterable[str], others: Iterable[str]) -> list[tuple[str, tuple[str, str]]]:
    """Return every second bubble of a row, and the pair before it: one of the row, one of the others."""
    married = pairwise(zip(names, others, strict=True))
    return [(rolled, pair) for pair, (rolled, _) in list(married)[::2]]


def _joints_of(others: tuple[str, ...]) -> tuple[Joint, ...]:
    """Return where the first of some bubbles begins, and where each ends."""
    return (ends_of(others[0])[0], *(ends_of(name)[1] for name in others)) if others else ()
