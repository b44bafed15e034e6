"""Steps as they stand in a file, read as far as possible even where parts of them are wrong.

The checks of meaning work on these, so that one slip does not hide all the others.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.language.choices import one_of
from balloon_usd.language.names import name_of_end
from balloon_usd.operations.inflate import Inflate
from balloon_usd.operations.modifiers import MODIFIERS
from balloon_usd.operations.rest import Rest
from balloon_usd.operations.table import BY_WORD, WORDS, words_in
from balloon_usd.operations.workbench import Place, UnnamedRest, Workbench

if TYPE_CHECKING:
    from collections.abc import Container, Iterable, Iterator, Mapping, Sequence

    from balloon_usd.language.problem import Path


@dataclass(frozen=True)
class StepEntry:
    """The plain data of one step."""

    path: Path
    entries: dict[str, object]

    @property
    def words(self) -> tuple[str, ...]:
        """Words of operations in it: one, if it is right."""
        return words_in(self.entries)

    @property
    def balloon(self) -> str | None:
        """The balloon that it names."""
        balloon = self.entries.get("balloon")
        return balloon if isinstance(balloon, str) else None

    @property
    def makes(self) -> dict[str, Path]:
        """Bubbles that it makes, with their places."""
        return {
            name: (*self.path, word, name) if BY_WORD[word].by_bubble else (*self.path, word)
            for word in self.words
            for name in BY_WORD[word].makes(self.entries[word])
        }

    @property
    def uses(self) -> tuple[str, ...]:
        """Bubbles that it works on."""
        return tuple(name for word in self.words for name in BY_WORD[word].uses(self.entries[word]))

    @property
    def names(self) -> tuple[str, ...]:
        """Bubbles that it makes or works on."""
        return (*self.makes, *self.uses)

    @property
    def pumped(self) -> dict[str, Path]:
        """Balloons that it blows up, with their places."""
        if Inflate.word not in self.words:
            return {}
        places = Inflate.places(self.entries[Inflate.word])
        return {name: (*self.path, *path) for path, name in reversed(places)}

    @property
    def whole(self) -> bool:
        """Whether it works on whole balloons of any kind."""
        return bool(self.words) and all(BY_WORD[word].whole for word in self.words)

    def check(self, bench: Workbench) -> None:
        """Complain of what makes no sense, and do the rest to the workpiece."""
        # Of keys that are none is told where they stand.
        if not self.words and set(self.entries) <= set(MODIFIERS):
            bench.complain(self.path, f"no operation, expected {one_of(WORDS)}")
        unnamed = "balloon" not in self.entries
        # Of bubbles that are there is known on which balloon they are.
        makes = unnamed and any(BY_WORD[word].bubble_kind is not None for word in self.words)
        makes = makes and bool(self.makes or not self.uses)
        twists = makes and not all(BY_WORD[word].on_rounds for word in self.words)
        place = Place(self.path, bench.balloon_of(self.path, self.balloon, makes=makes, twists=twists))
        for word in self.words:
            operation, balloon = BY_WORD[word], place.balloon if self.makes else None
            rounds = bench.rounds_among(balloon, self.uses)
            refused = {
                name: heart for name, heart in rounds.items() if not operation.takes_round(heart=heart)
            }
            bench.refuse_rounds(word, self.path, refused, rounds=operation.on_rounds)
            if refused and not self.makes:
                continue
            operation.check(self.entries[word], place, bench)
        bench.note_use(self.path, self.uses)
        bench.require_blown_up(place, place.balloon if self.makes else None, self.uses)
        if not any(BY_WORD[word].across for word in self.words):
            bench.check_owner(self.path, self.balloon, self.uses)


def steps_in(data: object) -> list[StepEntry]:
    """Return all steps of the plain data of a recipe that are mappings."""
    steps = data.get("steps") if isinstance(data, dict) else None
    entries = steps if isinstance(steps, (list, tuple)) else ()
    return [StepEntry(("steps", at), step) for at, step in enumerate(entries) if isinstance(step, dict)]


def workbench_of(
    balloons: Iterable[str], steps: Sequence[StepEntry], rounds: Mapping[str, bool] | None = None
) -> Workbench:
    """Return the workbench at which steps begin; `rounds`: which of the balloons are round, and whether they
    are hearts.
    """
    names = list(balloons)
    made_ever: dict[str, Path] = {}
    for step in steps:
        for name, path in step.makes.items():
            made_ever.setdefault(name, path)
    pumped: dict[str, Path] = {}
    for step in steps:
        pumped = step.pumped | pumped
    rests = _unnamed_rests(names, steps, made_ever)
    return Workbench(names, made_ever, rests, pumped, _rows(names, steps), rounds or {})


def _rows(balloons: Sequence[str], steps: Sequence[StepEntry]) -> dict[str, list[str]]:
    """Return all bubbles that steps make of each balloon, from its knot on."""
    rows: dict[str, list[str]] = {balloon: [] for balloon in balloons}
    for balloon, step in _by_balloon(balloons, steps):
        rows[balloon] += step.makes
    return rows


def _by_balloon(balloons: Sequence[str], steps: Sequence[StepEntry]) -> Iterator[tuple[str, StepEntry]]:
    """Yield the steps of which is known on what balloon they work, with that."""
    only = balloons[0] if len(balloons) == 1 else None
    for step in steps:
        if (balloon := step.balloon or only) in balloons:
            yield str(balloon), step


def _unnamed_rests(
    balloons: Sequence[str], steps: Sequence[StepEntry], made_ever: Container[str]
) -> dict[str, UnnamedRest]:
    """Return what is left of balloons whose rest no step names, by the names that it gets."""
    last = dict.fromkeys(balloons, -1)
    ended = set()
    for balloon, step in _by_balloon(balloons, steps):
        if step.makes:
            last[balloon] = int(step.path[1])
        if isinstance(step.entries.get(Rest.word), str):
            ended.add(balloon)
    names = {name_of_end(balloon, "rest", made_ever): balloon for balloon in last if balloon not in ended}
    return {name: UnnamedRest(balloon, last[balloon]) for name, balloon in names.items()}
