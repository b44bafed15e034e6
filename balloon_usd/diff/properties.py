"""The properties of two prims: their metadata, targets, connections, and values over all time codes."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from balloon_usd.diff.difference import ONLY, Difference, Spread
from balloon_usd.diff.flattening import Flattened, are_indices
from balloon_usd.diff.metadata import both, metadata_differences
from balloon_usd.diff.values import Gap, gap_between, same_bits
from balloon_usd.openusd import Sdf, Usd

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.diff.tolerance import Allowed, Tolerances

SHORT = 40
"""Characters of a value that is told instead of "values differ"."""


def property_differences(
    one: Any, other: Any, tolerances: Tolerances, touched: set[str]
) -> Iterator[Difference]:
    """What differs between the properties of two prims of one path.

    Args:
        one: of the first stage.
        other: of the second stage.
        tolerances: what floats may differ by.
        touched: takes the names of the properties whose values are not the same bits.
    """
    path = str(one.GetPath())
    names = [_names(prim) for prim in (one, other)]
    for name in sorted(names[0] | names[1]):
        if not (name in names[0] and name in names[1]):
            touched.add(name)
            yield Difference(path, ONLY[name not in names[0]], name)
            continue
        pair = one.GetProperty(name), other.GetProperty(name)
        kinds = [isinstance(p, Usd.Attribute) for p in pair]
        if kinds[0] != kinds[1]:
            yield Difference(path, "an attribute in one stage, a relationship in the other", name)
            continue
        for key, text in metadata_differences(*(p.GetAllAuthoredMetadata() for p in pair)):
            yield Difference(path, f"{key} is {text}", name)
        if all(kinds):
            yield from _attribute_differences(*pair, tolerances.of(name), touched)
        elif pair[0].GetTargets() != pair[1].GetTargets():
            found = both(*([str(target) for target in p.GetTargets()] for p in pair))
            yield Difference(path, f"targets differ: {found}", name)


def _attribute_differences(one: Any, other: Any, allowed: Allowed, touched: set[str]) -> Iterator[Difference]:
    path, name = str(one.GetPrim().GetPath()), str(one.GetName())
    types = [_authored_type(attribute) for attribute in (one, other)]
    if types[0] != types[1]:
        yield Difference(path, f"of type {types[0]} and {types[1]}", name)
    if one.GetConnections() != other.GetConnections():
        found = both(*([str(source) for source in a.GetConnections()] for a in (one, other)))
        yield Difference(path, f"connections differ: {found}", name)
    values = [Flattened(attribute) for attribute in (one, other)]
    times = [found.times() for found in values]
    if times[0] != times[1]:
        touched.add(name)
        yield Difference(path, f"times of the samples differ: {_times_text(*times)}", name)
    shared = times[0] if times[0] == times[1] else sorted({*times[0]} & {*times[1]})
    tally = Tally(allowed)
    for time in shared:
        tally.compare(time, *_values_at(time, *values))
    rest = Tally(allowed)
    rest.compare(None, *_values_at(None, *values))
    yield from tally.told(path, name, rest)
    if tally.touched or rest.touched:
        touched.add(name)


@dataclass
class Tally:
    """Two values, compared at one time code after the other."""

    allowed: Allowed
    touched: bool = False
    """Whether they were once not the same bits."""
    _compared: int = 0
    _worst: Gap | None = None
    _worst_time: float = 0.0
    _differing: list[float] = field(default_factory=list)
    _values: str = ""

    def compare(self, time: float | None, one: Any, other: Any) -> None:
        """Compare two values at a time code, None for the default."""
        self._compared += 1
        if same_bits(one, other):
            return
        gap = gap_between(one, other, self.allowed)
        self.touched = self.touched or gap is not None or hasattr(one, "__len__")
        if gap is None:
            return
        when = 0.0 if time is None else time
        self._differing.append(when)
        if self._worst is None or gap.by > self._worst.by:
            self._worst, self._worst_time = gap, when
            self._values = _short(one, other)

    def told(self, path: str, name: str, default: Tally) -> Iterator[Difference]:
        """Say in at most one sentence what was found at the time codes and in the default."""
        if self._worst is None:
            if default._worst is not None:
                by_default = " by default" if self._compared else ""
                yield Difference(path, f"{default._text}{by_default}", name, default._by)
            return
        times = self._differing
        spread = Spread(self._worst_time, times[0], times[-1], len(times), self._compared)
        text = f"{self._text} at {self._worst_time:g}; {spread}"
        if default._worst is not None:
            text += ", and by default"
        yield Difference(path, text, name, self._by, spread)

    @property
    def _text(self) -> str:
        told = self._worst.text if self._worst else ""
        return self._values if told == "values differ" and self._values else told

    @property
    def _by(self) -> float | None:
        return self._worst.by if self._worst and math.isfinite(self._worst.by) else None


def _authored_type(attribute: Any) -> str:
    """Return the type that a layer gives an attribute, which may be another one than its schema's."""
    specs = (spec for spec in attribute.GetPropertyStack() if isinstance(spec, Sdf.AttributeSpec))
    return next((str(spec.typeName) for spec in specs), "")


def _names(prim: Any) -> set[str]:
    """Return the names of the properties of a prim; indices are part of the values that they choose."""
    return {name for name in prim.GetAuthoredPropertyNames() if not are_indices(prim, name)}


def _values_at(time: float | None, one: Flattened, other: Flattened) -> tuple[Any, Any]:
    """Return two values at a time code, or the defaults; what leads nowhere in both as it is stored."""
    first, second = one.at(time), other.at(time)
    if first is None and second is None:
        return one.indices_at(time), other.indices_at(time)
    return first, second


def _short(one: Any, other: Any) -> str:
    """Name two values if they are short words or numbers."""
    if isinstance(one, (str, int, float)) and isinstance(other, (str, int, float)):
        text = both(one, other)
        return text if len(text) <= SHORT else ""
    return ""


def _times_text(one: list[float], other: list[float]) -> str:
    """Say how many samples there are, and the first that only one stage has."""
    lone = sorted({*one} ^ {*other})
    return f"{len(one)} and {len(other)} samples, {lone[0]:g} {ONLY[lone[0] not in one]}"
