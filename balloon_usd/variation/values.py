"""The values that a parameter takes: those of a list, or those of a range."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Context, Decimal
from fractions import Fraction
from numbers import Integral, Real
from typing import TYPE_CHECKING

from balloon_usd.language.problem import RecipeError, quoted
from balloon_usd.language.quantities import short_number
from balloon_usd.language.yaml_reader import read_yaml
from balloon_usd.recipe.writer import flow_text

if TYPE_CHECKING:
    from collections.abc import Sequence

MOST_VALUES = 100_000
"""Values of a range with a step."""
GRID = 3
"""Decimal places, counted from the first of its width, to which values of a continuous range are rounded."""
EXAMPLE = "red,blue or a range such as 8..14/2"

_QUANTITY = r"\s*([-+]?(?:[0-9]+(?:\.[0-9]+)?|\.[0-9]+)(?:[eE][-+]?[0-9]{1,2})?)\s*([A-Za-z\"]*|%)\s*"
_RANGE = re.compile(rf"{_QUANTITY}\.\.{_QUANTITY}(?:/{_QUANTITY})?", re.ASCII)
_MEANT_AS_RANGE = re.compile(r"(?:^|,)\s*(?:[-+]?\.?[0-9][^,]*\.\.|\.\.\s*[-+0-9])")
_LONGEST_RANGE = 120
_QUOTES = re.compile(r"[\"']")
_HEX = re.compile(r"(?:^|(?<=,))\s*(#[0-9A-Fa-f]+)\s*(?=,|$)")
_COMMENT = re.compile(r"(?:^|[\s,\[{])#")
_EXACT = Context(prec=300)


@dataclass(frozen=True)
class Listed:
    """Values that were given one by one."""

    values: tuple[object, ...]

    @property
    def count(self) -> int:
        """How many values there are."""
        return len(self.values)

    def value(self, at: int) -> object:
        """Return a value by its number, from 0."""
        return self.values[at]


@dataclass(frozen=True)
class Span:
    """Evenly spaced numbers, exact, each with the same unit."""

    text: str
    low: Fraction
    step: Fraction
    count: int
    unit: str
    continuous: bool
    """Whether the step is only what values are rounded to."""

    @property
    def with_step(self) -> str:
        """The same range with a step of some round number, as text."""
        return f"{self.text}/{short_number(float(self.step * 10**GRID))}{self.unit and ' ' + self.unit}"

    def value(self, at: int) -> object:
        """Return a value by its number, from 0: the shortest number that is nearest."""
        number = short_number(float(self.low + at * self.step))
        return f"{number} {self.unit}" if self.unit else number


Values = Listed | Span


def read_values(text: str) -> Values:
    """Read `red,blue`, `8..14/2` (a step) or `8..14` (continuous).

    Raises:
        ValueError: it is none of these, a range is empty, or it has too many values.
    """
    found = _RANGE.fullmatch(text) if len(text) <= _LONGEST_RANGE else None
    if found:
        return _span(text.strip(), found)
    if not _QUOTES.search(text):
        if _MEANT_AS_RANGE.search(text):
            raise ValueError(f"{quoted(text)} is no range, expected one alone, such as 8..14/2")
        text = _HEX.sub(r'"\1"', text)
        if _COMMENT.search(text):
            raise ValueError(f'{quoted(text)} has a # that begins a comment, expected it in "quotes"')
    return listed(_flow_list(text))


def listed(values: Sequence[object]) -> Listed:
    """Check values of plain data: texts, numbers, true and false, lists and mappings of them.

    Raises:
        ValueError: there is none, one stands twice, or one is not what a recipe can hold.
    """
    if len(values) == 0:
        raise ValueError(f"no value, expected some such as {EXAMPLE}")
    plain = tuple(_plain(value) for value in values)
    seen: set[str] = set()
    for value in plain:
        written = flow_text(value)
        if written in seen:
            raise ValueError(f"{quoted(written)} stands twice, expected each value once")
        seen.add(written)
    return Listed(plain)


def _flow_list(text: str) -> list[object]:
    """Read values parted by commas as the items of a YAML list."""
    try:
        document = read_yaml(f"[{text}]", "")
    except RecipeError as error:
        raise ValueError(f"{quoted(text)}: {error.problems[0].text}") from None
    if document.complaints:
        raise ValueError(f"{quoted(text)}: {document.complaints[0].text}")
    assert isinstance(document.data, list), "brackets stand round it"
    return document.data


def _plain(value: object) -> object:
    """Return a value as it is read from the text that is written of it."""
    try:
        data = _builtin(value)
        document = read_yaml(f"[{flow_text(data)}]", "")
    except (ValueError, TypeError, OverflowError, RecursionError):
        document = None
    if document is None or document.complaints or document.data != [data]:
        raise ValueError(f"{quoted(value)} is no value of a recipe, expected a text, a number, true or false")
    return data


def _builtin(value: object) -> object:
    """Turn numbers of other libraries, and tuples, into what is read back."""
    if isinstance(value, Mapping):
        return {key: _builtin(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_builtin(entry) for entry in value]
    if isinstance(value, bool):
        return value
    if isinstance(value, Real):
        return int(value) if isinstance(value, Integral) else float(value)
    return value


def _span(text: str, found: re.Match[str]) -> Span:
    first, last, width = (found[group] for group in (1, 3, 5))
    low, high = Fraction(first), Fraction(last)
    unit = _common_unit(text, [found[group] or "" for group in (2, 4, 6)])
    if high < low:
        raise ValueError(f"{text} goes down, expected the lower end first")
    if width is None:
        return _continuous(text, Decimal(first), Decimal(last), unit)
    step = Fraction(width)
    if step <= 0:
        raise ValueError(f"{text} does not advance, expected a step above 0")
    count = int((high - low) / step) + 1
    if count > MOST_VALUES:
        raise ValueError(f"{text} has {shown_count(count)} values, expected at most {MOST_VALUES}")
    return Span(text, low, step, count, unit, continuous=False)


def _continuous(text: str, low: Decimal, high: Decimal, unit: str) -> Span:
    width = _EXACT.subtract(high, low)
    if not width:
        raise ValueError(f"{text} is one value, expected two ends that differ")
    step = Fraction(10) ** (width.adjusted() - GRID)
    return Span(text, Fraction(low), step, int(Fraction(width) / step) + 1, unit, continuous=True)


def _common_unit(text: str, units: list[str]) -> str:
    given = list(dict.fromkeys(unit for unit in units if unit))
    if len(given) > 1:
        raise ValueError(f"{text} has the units {' and '.join(given)}, expected one of them")
    return given[0] if given else ""


def shown_count(count: int) -> str:
    """Write a number of things, however large."""
    return str(count) if count < 10**12 else f"{Decimal(count):.3g}"
