"""What is measured of a finished figure: units, limits, and the verdict."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping


class Verdict(StrEnum):
    """How a measure compares with its limit."""

    GOOD = "good"
    OFF = "off"
    """Beyond the limit."""
    NONE = "none"
    """The figure has nothing of the kind."""


@dataclass(frozen=True)
class Measure:
    """One number of a finished figure; the smaller, the better."""

    key: str
    unit: str
    limit: float
    """Largest value that is good."""
    digits: int
    """After the point, as it is written."""
    meaning: str

    def result(self, value: float | None, details: Mapping[str, object] = {}) -> dict[str, Any]:
        """Return a value with limit and verdict as plain data; None where there is nothing to measure."""
        if value is None:
            return {"value": None, "unit": self.unit, "limit": self.limit, "verdict": Verdict.NONE.value}
        rounded = round(float(value), self.digits)
        verdict = Verdict.GOOD if rounded <= self.limit else Verdict.OFF
        number = int(rounded) if self.digits == 0 else rounded
        return {"value": number, "unit": self.unit, "limit": self.limit, "verdict": verdict.value, **details}

    def largest(self, found: Mapping[str, float]) -> dict[str, Any]:
        """Return the result of differences by name: the largest of them, whose it is, and all of them."""
        if not found:
            return self.result(None)
        worst = max(found, key=lambda name: abs(found[name]))
        each = {name: round(float(value), self.digits) + 0.0 for name, value in found.items()}
        return self.result(abs(found[worst]), {"worst": worst, "each": each})


def _table(*measures: Measure) -> dict[str, Measure]:
    return {measure.key: measure for measure in measures}


MEASURES = _table(
    Measure("gas", "1", 0.10, 4, "largest difference of a bubble's gas from the plan, as a share of it"),
    Measure("squeezed", "1", 0.20, 4, "largest share of its volume by which others squeeze a bubble"),
    Measure("tail", "m", 0.01, 5, "largest difference of the flat tail left after a twist from the plan"),
    Measure("speed", "m/s", 0.005, 5, "largest speed of a vertex in the last half second"),
    Measure(
        "creep",
        "m",
        0.005,
        5,
        "largest way of a vertex from the let-go to the end; none where a joint comes undone",
    ),
    Measure("lean", "deg", 15.0, 1, "angle by which a figure that stands leans; none where none is to stand"),
    Measure("joints", "1", 0, 0, "joints that were meant to hold and do not"),
    Measure("passed", "1", 0, 0, "bubbles that were brought into a ring or between others and are out of it"),
    Measure(
        "unwound",
        "1",
        0.5,
        3,
        "largest share of its turns that a spiral or coil has lost; none where none is",
    ),
    Measure("crossings", "1", 0, 0, "pairs of an edge and a face that it pierces, but for those in one neck"),
    Measure("depth", "m", 0.001, 6, "depth of the deepest vertex at such a pair that lies inside a wall"),
    Measure(
        "necks",
        "1",
        5.0,
        2,
        "how far from its joint rubber goes through itself, in a neck's reach; farther out gas draws it in",
    ),
    Measure("symmetric_volume", "1", 0.05, 4, "largest difference of volume in a pair, as a share of it"),
    Measure(
        "symmetric_length",
        "1",
        0.05,
        4,
        "largest difference of length in a pair, ears apart, as a share of it",
    ),
    Measure("symmetric_place", "m", 0.02, 5, "largest distance of a bubble from its twin's mirror image"),
)
"""By key, in the order in which they are told."""
