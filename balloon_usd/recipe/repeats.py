"""Repeats and named values, written out: what the rest of the language reads has neither.

`let` names values, formulas reckon with them, and a `repeat` stands for its steps (or for its balloon), once
for each value of its counters. Every part that is written out keeps its place in the file.
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from balloon_usd.language.choices import one_of
from balloon_usd.language.formula import filled, is_formula, value_of
from balloon_usd.language.marks import Marks
from balloon_usd.language.names import name as checked_name
from balloon_usd.language.problem import Complaint, RecipeError, quoted
from balloon_usd.language.quantities import METRES

from .counters import CounterError, counters_of
from .held_words import MUST_HOLD

if TYPE_CHECKING:
    from balloon_usd.language.problem import Path
    from balloon_usd.language.scalars import Scalar
    from balloon_usd.language.yaml_reader import Document

LET, REPEAT, STEPS = "let", "repeat", "steps"
"""Keys that are written out."""
TEXTS = ("format", "name", "title", "source", "units")
"""Keys of a recipe whose values are never formulas."""
NOTE = "note"
"""The key of a step of which the same is true."""
MOST_STEPS = 2000
"""Steps of a recipe that is written out: the largest figures of the trade have some hundreds."""
MOST_BALLOONS = 200
"""Balloons of such a recipe."""
MOST_ROUNDS = 20_000
"""Rounds of all repeats."""
MOST_VALUES = 40_000
"""Values in it."""
LONGEST_CHAIN = 50
"""Named values that need each other, one through the other."""


def written_out(document: Document) -> Document:
    """Return a document in which every `let`, `repeat` and formula is written out.

    Raises:
        RecipeError: with all problems so far, where a named value or a repeat makes no sense.
    """
    data = document.data
    if not isinstance(data, dict) or not any(_special(data)):
        return document
    writing = _Writing(document, data)
    entries = writing.recipe()
    if writing.unreadable:
        raise RecipeError(document.marks.problems([*document.complaints, *writing.complaints]))
    return replace(
        document, data=entries, marks=writing.marks, complaints=(*writing.earlier(), *writing.complaints)
    )


def _special(data: object) -> Iterator[bool]:
    """Yield for every part of plain data whether it is to be written out."""
    if isinstance(data, dict):
        for key, value in data.items():
            yield key in (LET, REPEAT)
            yield from _special(value)
    elif isinstance(data, list):
        for value in data:
            yield from _special(value)
    else:
        yield is_formula(data)


class _Place(NamedTuple):
    """A part of the recipe: where it is written, where it comes to lie, and what its formulas may name."""

    old: Path
    new: Path
    names: ChainMap[str, Scalar]
    """Counters in front of the named values."""
    fills: bool = False
    """Whether formulas in angle brackets within names are filled in."""

    @property
    def counters(self) -> str:
        """In which of its repeats it is: `k = 3`."""
        counters = [(key, value) for each in self.names.maps[-2::-1] for key, value in each.items()]
        return ", ".join(f"{key} = {value}" for key, value in counters)

    @property
    def where(self) -> str:
        """The same behind a message; nothing outside of repeats."""
        return f" (with {self.counters})" if self.counters else ""

    def at(self, old: str | int, new: str | int) -> _Place:
        """Return one of its parts."""
        return self._replace(old=(*self.old, old), new=(*self.new, new))


class _Writing:
    """The state of one pass over a recipe."""

    def __init__(self, document: Document, data: dict[str, object]) -> None:
        self._document, self._data = document, data
        units = data.get("units")
        self._units = units if isinstance(units, str) and units in METRES else None
        self.marks = Marks(document.marks.file)
        self.complaints: list[Complaint] = []
        self.unreadable = False
        """Whether so much is wrong that what follows from it would be told, too."""
        self._lies: dict[Path, Path] = {}
        """Where the first copy of every part comes to lie."""
        self._values = self._rounds = 0
        self._full = False

    def recipe(self) -> dict[str, object]:
        """Write out the whole recipe."""
        names = ChainMap(self._named_values())
        found: dict[str, object] = {}
        if self.unreadable:
            return found
        for key, value in self._data.items():
            if key == LET:
                continue
            place = _Place((key,), (key,), names)
            self._mark(place)
            if key == STEPS and isinstance(value, list):
                steps: list[object] = []
                self._steps(value, place._replace(fills=True), steps)
                found[key] = steps
            elif key == "balloons" and isinstance(value, dict):
                found[key] = self._balloons(value, place)
            else:
                place = place._replace(fills=key == MUST_HOLD)
                found[key] = value if key in TEXTS else self._copy(value, place)
        return found

    def earlier(self) -> Iterator[Complaint]:
        """Yield what the reader has refused, where it lies now."""
        for each in self._document.complaints:
            at = each.at or self._document.marks.place(each.path)
            yield replace(each, path=self._lies.get(each.path, each.path), at=at)

    def _named_values(self) -> dict[str, Scalar]:
        """Reckon all named values, whichever stands first."""
        entries = self._data.get(LET, {})
        if not isinstance(entries, dict):
            self._refuse((LET,), f"{quoted(entries)} does not fit, expected entries such as {{ear: 3}}")
            return {}
        given = _NamedValues(entries, self._units)
        for key in entries:
            try:
                checked_name(key)
                given[key]
            except ValueError as error:
                self._refuse((LET, key), str(error))
        return dict(given.known)

    def _steps(self, entries: list[object], place: _Place, found: list[object]) -> None:
        """Append steps, and those of repeats one by one, to those found."""
        for index, entry in enumerate(entries):
            old = (*place.old, index)
            if isinstance(entry, dict) and REPEAT in entry:
                self._repeated_steps(entry, place._replace(old=old), found)
                continue
            if len(found) >= MOST_STEPS:
                self._stop(old, f"more than {MOST_STEPS} steps when written out, expected fewer repeats")
                return
            here = place._replace(old=old, new=(STEPS, len(found)))
            if here.counters:
                self.marks.repeats[here.new] = here.counters
            self._mark(here)
            found.append(self._copy(entry, here))

    def _repeated_steps(self, entry: dict[str, object], place: _Place, found: list[object]) -> None:
        steps = entry.get(STEPS)
        for key in entry:
            if key not in (REPEAT, STEPS, NOTE):
                what = f"stands beside {REPEAT}, expected {one_of([STEPS, NOTE])}"
                self._refuse((*place.old, key), f"{what}: put it into a step that is repeated")
        if not isinstance(steps, list) or not steps:
            told = f"{quoted(steps)} does not fit" if STEPS in entry else "is missing"
            self._refuse((*place.old, STEPS), f"{told}, expected a list of steps that are repeated")
            return
        if not isinstance(entry.get(NOTE, ""), str):
            self._refuse((*place.old, NOTE), f"{quoted(entry[NOTE])} is no text, expected it in quotes")
        for names in self._counted(entry[REPEAT], place):
            self._steps(steps, _Place((*place.old, STEPS), place.new, names, fills=True), found)

    def _balloons(self, entries: dict[str, object], place: _Place) -> dict[str, object]:
        """Write out balloons, of which a repeated one stands for several."""
        found: dict[str, object] = {}
        for key, entry in entries.items():
            if len(found) > MOST_BALLOONS:
                self._stop(
                    (*place.old, key), f"more than {MOST_BALLOONS} balloons when written out, expected fewer"
                )
            here = place._replace(old=(*place.old, key))
            if not isinstance(entry, dict) or REPEAT not in entry:
                self._put(found, key, entry, here)
                continue
            rest = {each: value for each, value in entry.items() if each != REPEAT}
            for names in self._counted(entry[REPEAT], here):
                self._put(found, key, rest, here._replace(names=names, fills=True))
        return found

    def _counted(self, value: object, place: _Place) -> Iterator[ChainMap[str, Scalar]]:
        """Yield the names known in each of the repeats."""
        try:
            rounds = counters_of(value, place.names, self._units)
        except CounterError as error:
            self._refuse((*place.old, REPEAT, *error.keys), str(error))
            return
        for counters in rounds:
            # What is wrong in one round is wrong in all.
            if self.unreadable:
                return
            self._rounds += 1
            if self._rounds > MOST_ROUNDS:
                self._stop(place.old, f"more than {MOST_ROUNDS} rounds of repeats, expected fewer")
            yield place.names.new_child(counters)

    def _copy(self, value: object, place: _Place) -> object:
        """Write out a part that is no list of steps."""
        self._values += 1
        if self._values > MOST_VALUES:
            self._stop(place.old, f"more than {MOST_VALUES} values when written out, expected fewer repeats")
            return None
        if isinstance(value, dict):
            found: dict[str, object] = {}
            for key, part in value.items():
                self._put(found, key, part, place._replace(old=(*place.old, key)))
            return found
        if isinstance(value, list):
            return [self._entry(part, place.at(index, index)) for index, part in enumerate(value)]
        return self._scalar(value, place)

    def _put(self, found: dict[str, object], key: str, value: object, place: _Place) -> None:
        """Write out an entry of a mapping; `place` is where it is written, in what it comes to lie."""
        try:
            name = filled(key, place.names, self._units) if place.fills else key
        except ValueError as error:
            self._refuse(place.old, f"{error}{place.where}")
            return
        if name in found:
            hint = (
                "another one" if place.counters else "one with a counter of its repeat in it, or another one"
            )
            self._refuse(place.old, f"the name {quoted(name)} is there already, expected {hint}")
            return
        here = place._replace(new=(*place.new, name))
        self._mark(here)
        is_note = key == NOTE and place.new[:-1] == (STEPS,)
        found[name] = value if is_note else self._copy(value, here)

    def _entry(self, value: object, place: _Place) -> object:
        self._mark(place)
        return self._copy(value, place)

    def _scalar(self, value: object, place: _Place) -> object:
        try:
            if is_formula(value):
                return value_of(str(value), place.names, self._units)
            if place.fills and isinstance(value, str):
                return filled(value, place.names, self._units)
        except ValueError as error:
            at = self._document.marks.place(place.old)
            # Of a step the marks tell it.
            where = "" if place.new[0] == STEPS else place.where
            self.complaints.append(Complaint(place.new, f"{error}{where}", at))
            # What is wrong in one round is wrong in all.
            self.unreadable = self.unreadable or bool(place.counters)
        return value

    def _mark(self, place: _Place) -> None:
        """Let a part keep its place in the file."""
        self._lies.setdefault(place.old, place.new)
        written = self._document.marks
        for before, after in ((written.keys, self.marks.keys), (written.values, self.marks.values)):
            if place.old in before:
                after[place.new] = before[place.old]

    def _refuse(self, path: Path, text: str) -> None:
        """Complain of what leaves the rest without sense, if the reader has not already."""
        self.unreadable = True
        if all(each.path != path for each in self._document.complaints):
            self.complaints.append(Complaint(path, text))

    def _stop(self, path: Path, text: str) -> None:
        if not self._full:
            self._full = True
            self._refuse(path, text)


class _NamedValues(Mapping[str, "Scalar"]):
    """The values of `let`, each reckoned when it is asked for."""

    def __init__(self, entries: dict[str, object], units: str | None) -> None:
        self._entries, self._units = entries, units
        self.known: dict[str, Scalar] = {}
        self._asked: list[str] = []
        """Names that are being reckoned, each for the one before it."""

    def __getitem__(self, key: str) -> Scalar:
        """Return a value; raises `ValueError` where it makes no sense."""
        if key in self.known:
            return self.known[key]
        if len(self._asked) > LONGEST_CHAIN:
            raise ValueError(
                f"needs a chain of more than {LONGEST_CHAIN} other values, expected a shorter one"
            )
        if key in self._asked:
            way = " -> ".join([*self._asked[self._asked.index(key) :], key])
            raise ValueError(f"names itself: {way}, expected a value that does not need itself")
        value = self._entries[key]
        if not isinstance(value, (str, int, float, bool)):
            raise ValueError(f"{quoted(value)} does not fit, expected a number, a length or a text")
        self._asked.append(key)
        try:
            self.known[key] = value_of(str(value), self, self._units) if is_formula(value) else value
        finally:
            self._asked.pop()
        return self.known[key]

    def __contains__(self, key: object) -> bool:
        return key in self._entries

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)
