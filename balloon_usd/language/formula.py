"""Formulas: simple arithmetic on numbers and quantities, such as `= 2 * ear + 1 cm`."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Context, Decimal, localcontext
from typing import NamedTuple

from balloon_usd.language.choices import unknown
from balloon_usd.language.problem import quoted
from balloon_usd.language.quantities import METRES, NEWTONS, NUMBER, SECONDS, UNSIGNED, short_number
from balloon_usd.language.scalars import Scalar

Names = Mapping[str, Scalar]
"""Values by the names that formulas use."""

LONGEST_FORMULA = 200
"""Characters."""
DEEPEST = 16
"""Brackets and signs within each other."""
LARGEST = Decimal(10) ** 12
"""No number about balloons is larger."""
DIGITS = 12
"""Significant digits of a result: a third times three is one."""

_EXACT = Context(prec=28)
_TOKEN = re.compile(
    rf"\s*(?:(?P<number>{UNSIGNED})"
    r"|(?P<word>[A-Za-z_][A-Za-z0-9_]*)|(?P<sign>[-+*/()])|(?P<mark>[\"%]))",
    re.ASCII,
)
_QUANTITY = re.compile(rf"\s*({NUMBER})\s*([A-Za-z]+|\"|%)\s*", re.ASCII)
_PLACEHOLDER = re.compile(r"<([^<>]*)>")


class Kind(NamedTuple):
    """Units of one kind of quantity."""

    units: Mapping[str, Decimal]
    """Size of each."""
    usual: str | None
    """The one in which bare numbers are; None: that of the recipe."""


KINDS: tuple[Kind, ...] = (
    Kind(METRES, None),
    Kind({"deg": Decimal(1), "rad": Decimal(180) / Decimal(repr(math.pi))}, "deg"),
    Kind(NEWTONS, "N"),
    Kind(SECONDS, "s"),
    Kind({"%": Decimal(1)}, "%"),
)
"""All kinds of quantities that a recipe knows."""
_KIND_OF = {unit: kind for kind in KINDS for unit in kind.units}


@dataclass(frozen=True)
class Quantity:
    """A number with a unit, or a bare one."""

    number: Decimal
    unit: str = ""

    def __str__(self) -> str:
        """Write it as a recipe does."""
        number = short_number(float(f"{self.number:.{DIGITS}g}"))
        return f"{number} {self.unit}".rstrip()


def is_formula(value: object) -> bool:
    """Tell whether a value of a recipe is a formula: a text that begins with `=`."""
    return isinstance(value, str) and value.lstrip().startswith("=")


def value_of(formula: str, names: Names, units: str | None) -> Scalar:
    """Return what a formula gives, as a recipe would say it; `units`: of bare lengths.

    Raises:
        ValueError: it is no formula, names what is not there, or cannot be reckoned.
    """
    found = _Reckoning(formula.strip().removeprefix("="), names, units).result()
    if not isinstance(found, Quantity):
        return found
    return str(found) if found.unit else short_number(float(f"{found.number:.{DIGITS}g}"))


def filled(text: str, names: Names, units: str | None) -> str:
    """Return a text with the value of each formula that stands in it in angle brackets: `ear_<k + 1>`.

    Raises:
        ValueError: as `value_of`, or a value is neither a text nor a whole number.
    """

    def value(found: re.Match[str]) -> str:
        given = value_of(found[1], names, units)
        if isinstance(given, bool) or not isinstance(given, (int, str)):
            raise ValueError(f"<{found[1]}> is {quoted(given)}, expected a whole number or a text in a name")
        return str(given)

    return _PLACEHOLDER.sub(value, text)


class _Reckoning:
    """One pass over a formula, by recursive descent."""

    def __init__(self, text: str, names: Names, units: str | None) -> None:
        self._text, self._names, self._units = text, names, units
        if len(text) > LONGEST_FORMULA:
            raise ValueError(f"a formula of {len(text)} characters, expected at most {LONGEST_FORMULA}")
        self._tokens = self._read()
        self._at = 0

    def result(self) -> Quantity | str | bool:
        with localcontext(_EXACT):
            found = self._sum(0)
        if self._at < len(self._tokens):
            raise self._unfit("the end of the formula")
        return found

    def _read(self) -> list[tuple[str, str]]:
        tokens, at = [], 0
        while self._text[at:].strip():
            found = _TOKEN.match(self._text, at)
            if found is None:
                rest = self._text[at:].strip()
                raise ValueError(f"{quoted(rest)} is no formula, expected numbers, names, + - * / and ( )")
            tokens.append((found.lastgroup or "", found[0].strip()))
            at = found.end()
        return tokens

    def _next(self) -> tuple[str, str]:
        return self._tokens[self._at] if self._at < len(self._tokens) else ("", "")

    def _takes(self, *signs: str) -> str | None:
        _, text = self._next()
        if text not in signs:
            return None
        self._at += 1
        return text

    def _sum(self, depth: int) -> Quantity | str | bool:
        found = self._product(depth)
        while sign := self._takes("+", "-"):
            found = self._added(_number(found), _number(self._product(depth)), sign)
        return found

    def _product(self, depth: int) -> Quantity | str | bool:
        found = self._factor(depth)
        while sign := self._takes("*", "/"):
            one, other = _number(found), _number(self._factor(depth))
            found = _times(one, other) if sign == "*" else self._divided(one, other)
        return found

    def _factor(self, depth: int) -> Quantity | str | bool:
        if depth > DEEPEST:
            raise ValueError(f"nested deeper than {DEEPEST} brackets and signs")
        if self._takes("-"):
            found = _number(self._factor(depth + 1))
            return Quantity(-found.number, found.unit)
        if self._takes("("):
            inside = self._sum(depth + 1)
            if not self._takes(")"):
                raise self._unfit(")")
            return inside
        kind, text = self._next()
        if kind not in ("number", "word"):
            raise self._unfit("a number, a name or (")
        self._at += 1
        return self._measured(text) if kind == "number" else self._named(text)

    def _measured(self, text: str) -> Quantity:
        """Return a number with the unit that may follow it."""
        kind, unit = self._next()
        if kind not in ("word", "mark"):
            return _sized(Quantity(Decimal(text)))
        if unit not in _KIND_OF:
            what = f"expected {text} * {unit}" if unit in self._names else unknown("unit", unit, _KIND_OF)
            raise ValueError(f"{quoted(f'{text} {unit}')} is no quantity, {what}")
        self._at += 1
        return _sized(Quantity(Decimal(text), unit))

    def _named(self, name: str) -> Quantity | str | bool:
        if name not in self._names:
            raise ValueError(unknown("name", name, self._names))
        value = self._names[name]
        if isinstance(value, bool) or value is None:
            return bool(value)
        if isinstance(value, (int, float)):
            if not math.isfinite(value):
                raise ValueError(f"{name} is {value}, expected a finite number")
            return _sized(Quantity(Decimal(repr(value))))
        found = _QUANTITY.fullmatch(value)
        if found is None or found[2] not in _KIND_OF:
            return value
        return _sized(Quantity(Decimal(found[1]), found[2]))

    def _added(self, one: Quantity, other: Quantity, sign: str) -> Quantity:
        kind = _KIND_OF.get(one.unit or other.unit)
        if kind is None:
            total = one.number + other.number if sign == "+" else one.number - other.number
            return _sized(Quantity(total))
        usual = kind.usual or self._units
        first, second = one.unit or usual, other.unit or usual
        if first is None or second is None:
            bare = one if first is None else other
            raise ValueError(f"{bare} has no unit in a sum of lengths, expected one, or units: cm on top")
        if _KIND_OF.get(first) is not _KIND_OF.get(second):
            raise ValueError(f"{one} and {other} cannot be added, expected quantities of one kind")
        more = other.number * kind.units[second] / kind.units[first]
        return _sized(Quantity(one.number + more if sign == "+" else one.number - more, first))

    def _divided(self, one: Quantity, other: Quantity) -> Quantity:
        if other.number == 0:
            raise ValueError(f"{one} is divided by {other}, expected a divisor that is not 0")
        if not other.unit:
            return _sized(Quantity(one.number / other.number, one.unit))
        kind = _KIND_OF[other.unit]
        first = one.unit or kind.usual or self._units
        if first is None or first not in kind.units:
            raise ValueError(f"{one} cannot be divided by {other}, expected quantities of one kind")
        return _sized(Quantity(one.number * kind.units[first] / (other.number * kind.units[other.unit])))

    def _unfit(self, expected: str) -> ValueError:
        _, text = self._next()
        found = f"{quoted(text)} does not fit there" if text else "it ends too early"
        return ValueError(f"{quoted(self._text.strip())} is no formula: {found}, expected {expected}")


def _number(value: Quantity | str | bool) -> Quantity:
    """Return a value with which can be reckoned."""
    if isinstance(value, Quantity):
        return value
    shown = "true or false" if isinstance(value, bool) else f"the text {quoted(value)}"
    raise ValueError(f"{shown} stands in arithmetic, expected a number or a quantity such as 4 in")


def _times(one: Quantity, other: Quantity) -> Quantity:
    if one.unit and other.unit:
        raise ValueError(f"{one} cannot be multiplied by {other}, expected one of them without a unit")
    return _sized(Quantity(one.number * other.number, one.unit or other.unit))


def _sized(quantity: Quantity) -> Quantity:
    if abs(quantity.number) > LARGEST:
        raise ValueError(f"{quantity.number:.3g} is too large, expected at most {LARGEST:g}")
    return quantity
