"""Counters of a repeat: `9`, `{k: 9}`, `{k: 2 to 9}`, `{side: [left, right]}`, or several of equal length."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from balloon_usd.language.formula import is_formula, value_of
from balloon_usd.language.names import name as checked_name
from balloon_usd.language.problem import quoted

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.language.formula import Names
    from balloon_usd.language.scalars import Scalar

MOST_REPEATS = 500
"""Times that one repeat repeats."""
EXPECTED = "expected a number of times, {k: 9}, {k: 2 to 9} or {side: [left, right]}"

_RANGE = re.compile(r"\s*(.+?)\s+to\s+(.+?)\s*", re.ASCII | re.DOTALL)


class CounterError(ValueError):
    """A counter makes no sense; `keys` leads to it."""

    def __init__(self, text: str, keys: tuple[str, ...] = ()) -> None:
        super().__init__(text)
        self.keys = keys


def counters_of(value: object, names: Names, units: str | None) -> list[dict[str, Scalar]]:
    """Return the values of all counters in each of the repeats; `names`: those that are known already.

    Raises:
        CounterError: they make no sense.
    """
    if not isinstance(value, dict):
        try:
            return [{} for _ in range(_times(value, names, units))]
        except ValueError as error:
            raise CounterError(str(error)) from None
    if not value:
        raise CounterError(f"is empty, {EXPECTED}")
    columns: dict[str, Sequence[Scalar]] = {}
    for key, entry in value.items():
        try:
            checked_name(key)
            if key in names:
                raise ValueError(f"counter {quoted(key)} has the name of a value or of another counter")
            columns[key] = _column(entry, names, units)
        except ValueError as error:
            raise CounterError(str(error), (key,)) from None
    lengths = {key: len(column) for key, column in columns.items()}
    if len(set(lengths.values())) > 1:
        told = ", ".join(f"{key} {length}" for key, length in lengths.items())
        raise CounterError(f"counters differ in how many values they have ({told}), expected equally many")
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]


def _column(value: object, names: Names, units: str | None) -> Sequence[Scalar]:
    """Return the values that one counter takes."""
    if isinstance(value, list):
        if not 1 <= len(value) <= MOST_REPEATS:
            raise ValueError(f"{len(value)} values of a counter, expected 1 to {MOST_REPEATS}")
        return [_entry(each, names, units) for each in value]
    found = _RANGE.fullmatch(value) if isinstance(value, str) and not is_formula(value) else None
    if found is None:
        return range(1, _times(value, names, units) + 1)
    first, last = (_whole(value_of(end, names, units), value) for end in found.groups())
    if not 0 <= last - first < MOST_REPEATS:
        expected = f"expected up to {MOST_REPEATS} numbers, such as 2 to 9"
        raise ValueError(f"{quoted(value)} is no range, {expected}")
    return range(first, last + 1)


def _entry(value: object, names: Names, units: str | None) -> Scalar:
    if not isinstance(value, (str, int, float)):
        raise ValueError(f"{quoted(value)} is no value of a counter, expected a number or a text")
    return value_of(str(value), names, units) if is_formula(value) else value


def _times(value: object, names: Names, units: str | None) -> int:
    given = value_of(str(value), names, units) if is_formula(value) else value
    times = _whole(given, value)
    if not 1 <= times <= MOST_REPEATS:
        raise ValueError(f"{times} times, expected 1 to {MOST_REPEATS}")
    return times


def _whole(number: object, value: object) -> int:
    if isinstance(number, float) and number.is_integer():
        return int(number)
    if isinstance(number, bool) or not isinstance(number, int):
        raise ValueError(f"{quoted(value)} does not say how often, {EXPECTED}")
    return number
