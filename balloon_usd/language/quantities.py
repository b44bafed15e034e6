"""Lengths, angles, forces and bounded numbers: from what a maker writes to SI units, and back."""

import math
import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from typing import Annotated, Any, Literal, SupportsFloat

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from balloon_usd.language.choices import one_of
from balloon_usd.language.problem import quoted

Units = Literal["mm", "cm", "m", "in", "ft"]
LengthLike = float | str
"""Metres, or a text with its own unit such as "4 in"."""

METRES: dict[str, Decimal] = {
    "mm": Decimal("0.001"),
    "cm": Decimal("0.01"),
    "m": Decimal(1),
    "in": Decimal("0.0254"),
    '"': Decimal("0.0254"),
    "ft": Decimal("0.3048"),
    "finger": Decimal("0.02"),
    "fingers": Decimal("0.02"),
    "hand": Decimal("0.08"),
    "hands": Decimal("0.08"),
}
"""Metres in one unit: international inch and foot; a finger and a hand are so wide, four fingers a hand."""

NEWTONS: dict[str, Decimal] = {"N": Decimal(1), "mN": Decimal("0.001")}
"""Newtons in one unit."""

SECONDS: dict[str, Decimal] = {
    "s": Decimal(1),
    "min": Decimal(60),
    "h": Decimal(3600),
    "day": Decimal(86400),
    "days": Decimal(86400),
}
"""Seconds in one unit."""

LONGEST = 5.0
"""Metres. Three times the longest balloon in the trade, so that a slip of the unit is seen."""

UNSIGNED = r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]{1,3})?"
"""Pattern of a number without a sign."""
NUMBER = rf"[-+]?{UNSIGNED}"
"""Pattern of a number."""
_QUANTITY = re.compile(rf"\s*({NUMBER})\s*([A-Za-z\"]*)\s*", re.ASCII)
_FRACTION = re.compile(r"\s*(?:([0-9]{1,4})\s+)?([0-9]{1,4})/([1-9][0-9]{0,3})\s*([A-Za-z\"]*)\s*", re.ASCII)
_PERCENT = re.compile(rf"\s*{NUMBER}\s*%?\s*", re.ASCII)
_DECIMAL_COMMA = re.compile(r"\s*[0-9]+,[0-9]+\s*[a-z\"]*\s*", re.ASCII)
_LONGEST_TEXT = 40


class UnitMissingError(ValueError):
    """A bare number where the recipe names no `units`."""


@dataclass(frozen=True)
class Reading:
    """How bare numbers are meant while a file is read."""

    units: str | None


def metres(value: object, units: str | None) -> float:
    """Read a length in metres: a number in `units`, or a text with its own unit.

    Raises:
        ValueError: if it is no length, has no unit or an unknown one.
    """
    number, unit = _fraction(value) or _number_and_unit(value, "length", '"12 mm" or "4 in"')
    unit = unit or units or ""
    if not unit:
        remedy = f'expected units: cm at the top of the recipe, or a length such as "{_plain(number)} cm"'
        raise UnitMissingError(f"{_plain(number)} has no unit, {remedy}")
    if unit not in METRES:
        raise ValueError(f"unknown length unit {quoted(unit)}, expected {one_of(METRES)}")
    return float(number * METRES[unit])


def radians(value: object) -> float:
    """Read an angle in radians: a number is in degrees; "60 deg" and "1.2 rad" say so.

    Raises:
        ValueError: if it is no angle or has an unknown unit.
    """
    number, unit = _number_and_unit(value, "angle", '60 or "60 deg"')
    if unit not in ("", "deg", "rad"):
        raise ValueError(f"unknown angle unit {quoted(unit)}, expected one of deg, rad")
    return float(number) if unit == "rad" else math.radians(float(number))


def newtons(value: object) -> float:
    """Read a force in newtons: a number is in newtons; "2 N" and "500 mN" say so.

    Raises:
        ValueError: if it is no force or has an unknown unit.
    """
    return _in_units(value, NEWTONS, "force", '2 or "2 N"', "force unit")


def seconds(value: object) -> float:
    """Read a time in seconds: a number is in seconds; "6 h" and "2 days" say so.

    Raises:
        ValueError: if it is no time or has an unknown unit.
    """
    return _in_units(value, SECONDS, "time", '"6 h" or "2 days"', "unit of time")


def length_entry(length: float, units: str | None) -> int | float | str:
    """Write a length (m) as it stands in a recipe with these `units`, so that it reads back the same."""
    exact = Decimal(repr(float(length)))
    if units is not None and exact.is_finite():
        entry = short_number(float(exact / METRES[units]))
        if metres(entry, units) == length:
            return entry
    return f"{length!r} m"


def written_length(length: LengthLike, units: str | None) -> int | float | str:
    """Write a length (m) as it stands in a recipe with these `units`; a text stays as it is.

    Raises:
        TypeError: it is neither a number nor a text.
    """
    if isinstance(length, str):
        return length
    if not isinstance(length, SupportsFloat):
        raise TypeError(f'{length!r} is no length, expected a number of metres, or a text such as "5 cm"')
    return length_entry(float(length), units)


def angle_entry(angle: float) -> int | float | str:
    """Write an angle (radians) in degrees where that reads back the same."""
    degrees = short_number(round(math.degrees(angle), 9))
    return degrees if math.radians(degrees) == angle else f"{angle!r} rad"


def duration_entry(duration: float) -> str:
    """Write a time (s) in the largest unit in which it is a whole number."""
    exact = Decimal(repr(float(duration)))
    whole = [unit for unit in ("days", "h", "min") if exact % SECONDS[unit] == 0]
    unit = next((unit for unit in whole if exact >= SECONDS[unit]), "s")
    number = short_number(float(exact / SECONDS[unit]))
    return "1 day" if (number, unit) == (1, "days") else f"{number} {unit}"


def short_number(number: float) -> int | float:
    """Drop the `.0` of a whole number."""
    return int(number) if math.isfinite(number) and number == int(number) else number


def _in_units(value: object, units: Mapping[str, Decimal], what: str, example: str, called: str) -> float:
    """Read a quantity in SI units, in which a bare number is."""
    number, unit = _number_and_unit(value, what, example)
    if unit and unit not in units:
        raise ValueError(f"unknown {called} {quoted(unit)}, expected {one_of(units)}")
    return float(number * units[unit] if unit else number)


def _fraction(value: object) -> tuple[Decimal, str] | None:
    """Return what makers with inches write, such as `1 1/2 in` or `3/4`, and its unit; None of all else."""
    found = _FRACTION.fullmatch(value) if isinstance(value, str) and len(value) <= _LONGEST_TEXT else None
    if found is None:
        return None
    return Decimal(found[1] or 0) + Decimal(found[2]) / Decimal(found[3]), found[4]


def _number_and_unit(value: object, what: str, example: str) -> tuple[Decimal, str]:
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        number = Decimal(repr(value))
        if not number.is_finite():
            raise ValueError(f"{value} is no {what}, expected a finite number such as {example}")
        return number, ""
    if not isinstance(value, str) or len(value) > _LONGEST_TEXT:
        raise ValueError(f"{quoted(value)} is no {what}, expected {example}")
    found = _QUANTITY.fullmatch(value)
    if not found:
        if _DECIMAL_COMMA.fullmatch(value):
            point = quoted(value.replace(",", "."))
            raise ValueError(f"{quoted(value)} has a decimal comma, expected a decimal point: {point}")
        raise ValueError(f"{quoted(value)} is no {what}, expected {example}")
    return Decimal(found[1]), found[2]


def _plain(number: Decimal) -> str:
    return f"{float(number):g}"


class Read(ABC):
    """A quantity that is read from what a recipe says."""

    @abstractmethod
    def read(self, value: object) -> float:
        """Read it, or refuse what is none or out of range."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_before_validator_function(self.read, handler(source))


@dataclass(frozen=True)
class Between(Read):
    """A finite number from `low` to `high`, in steps of `step` where that is given."""

    low: float
    high: float
    unit: str = ""
    step: float | None = None
    whole: bool = False

    def read(self, value: object) -> float:
        """Take a number as it is, or refuse what is none or out of range."""
        wanted = f"{self.low:g} to {self.high:g}{self.unit and ' ' + self.unit}"
        if self.step:
            wanted += f" in steps of {self.step:g}"
        kinds = (int,) if self.whole else (int, float)
        if isinstance(value, bool) or not isinstance(value, kinds):
            kind = "whole number" if self.whole else "number"
            raise ValueError(f"{quoted(value)} is no {kind}, expected {wanted}")
        if math.isnan(value):
            raise ValueError(f"nan is no number, expected {wanted}")
        in_steps = self.step is None or not math.isfinite(value) or value % self.step == 0
        if not (self.low <= value <= self.high and in_steps):
            clamped = min(max(value, self.low), self.high)
            near = round(clamped / self.step) * self.step if self.step else clamped
            raise ValueError(f"{value:g} is out of range, expected {wanted}, the nearest is {near:g}")
        return value

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        step = {"multipleOf": self.step} if self.step else {}
        return handler(schema) | {"minimum": self.low, "maximum": self.high} | step


@dataclass(frozen=True)
class LengthWithin:
    """A length above `low` (or at it, if `low_included`) and at most `high`, in metres."""

    low: float = 0.0
    high: float = LONGEST
    low_included: bool = False

    def read(self, value: object, info: ValidationInfo) -> float:
        """Convert to metres: bare numbers are metres in Python and in the recipe's `units` in a file."""
        units = info.context.units if isinstance(info.context, Reading) else "m"
        length = metres(value, units)
        above = length >= self.low if self.low_included else length > self.low
        if not (above and length <= self.high):
            more = "at least" if self.low_included else "more than"
            wanted = f"{more} {_shown(self.low)} and at most {_shown(self.high)}"
            raise ValueError(f"{_shown(length)} is out of range, expected {wanted}")
        return length

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_before_validator_function(self.read, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        least = {"minimum" if self.low_included else "exclusiveMinimum": 0} if self.low >= 0.0 else {}
        units, sign = "|".join(METRES), "\\+" if self.low >= 0.0 else "[-+]"
        text = {"type": "string", "pattern": rf"^\s*{sign}?[0-9.]+([eE][-+]?[0-9]+)?\s*({units})?\s*$"}
        fraction = {"type": "string", "pattern": rf"^\s*([0-9]+\s+)?[0-9]+/[0-9]+\s*({units})?\s*$"}
        return {"anyOf": [{"type": "number", **least}, text, fraction]}


@dataclass(frozen=True)
class UpTo(Read):
    """A quantity above 0 and at most `most`, in SI units."""

    most: float
    """As a bare number in a recipe."""
    in_si: Callable[[object], float]
    """Reads what is written."""
    units: tuple[str, ...]
    """That may follow the number."""
    shown: Callable[[float], str]
    """Writes what was read and is too much."""
    limit: str
    """`most` as it is told."""

    def read(self, value: object) -> float:
        """Convert to SI units."""
        found = self.in_si(value)
        if not 0.0 < found <= self.in_si(self.most):
            what = f"expected more than 0 and at most {self.limit}"
            raise ValueError(f"{self.shown(found)} is out of range, {what}")
        return found

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        text = {"type": "string", "pattern": rf"^\s*\+?[0-9.]+\s*({'|'.join(self.units)})?\s*$"}
        return {"anyOf": [{"type": "number", "exclusiveMinimum": 0, "maximum": self.most}, text]}


@dataclass(frozen=True)
class PercentWithin(Read):
    """A share from `low` to `high`, in percent."""

    low: float
    high: float

    def read(self, value: object) -> float:
        """Read a share in percent: a number is in percent; "20 %" says so."""
        if isinstance(value, str) and not _PERCENT.fullmatch(value):
            raise ValueError(f'{quoted(value)} is no share, expected 20 or "20 %"')
        text = value.rstrip().removesuffix("%") if isinstance(value, str) else value
        share = float(_number_and_unit(text, "share", '20 or "20 %"')[0])
        wanted = f"{self.low:g} to {self.high:g} %"
        if not self.low <= share <= self.high:
            near = min(max(share, self.low), self.high)
            raise ValueError(f"{share:g} % is out of range, expected {wanted}, the nearest is {near:g} %")
        return share

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        text = {"type": "string", "pattern": r"^\s*\+?[0-9.]+([eE][-+]?[0-9]+)?\s*%?\s*$"}
        return {"anyOf": [{"type": "number", "minimum": self.low, "maximum": self.high}, text]}


def _shown(length: float) -> str:
    for unit, scale in (("m", 1.0), ("cm", 0.01)):
        if abs(length) >= scale:
            return f"{length / scale:g} {unit}"
    return f"{length / 0.001:g} mm" if length else "0"


Length = Annotated[float, LengthWithin()]
FlatTail = Annotated[float, LengthWithin(low_included=True)]
Angle = Annotated[
    float, UpTo(180, radians, ("deg", "rad"), lambda angle: f"{math.degrees(angle):g} degrees", "180")
]
Force = Annotated[float, UpTo(100.0, newtons, tuple(NEWTONS), lambda force: f"{force:g} N", "100 N")]
Duration = Annotated[
    float, UpTo(30.0 * 86400.0, seconds, tuple(SECONDS), lambda time: f"{time:g} s", "30 days")
]
