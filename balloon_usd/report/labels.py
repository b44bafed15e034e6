"""Labels that keep out of each other's way: names beside the ends of curves, steps above their moments."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence


def spread(wanted: Sequence[float], apart: float, low: float, high: float) -> list[float]:
    """Move places (pixels) as little as need be until neighbours are so far apart and all lie within.

    Places keep their order. Where there is no room they are spread evenly from `low` to `high`.
    """
    order = sorted(range(len(wanted)), key=lambda index: wanted[index])
    if (len(wanted) - 1) * apart > high - low:
        apart = (high - low) / (len(wanted) - 1)
    groups: list[tuple[float, int]] = []
    # Labels that touch become one group, which sits at the mean of what its labels want.
    for index in order:
        middle, count = wanted[index], 1
        middle = _within(middle, count, apart, low, high)
        while groups and groups[-1][0] + 0.5 * apart * (groups[-1][1] + count) > middle:
            earlier, more = groups.pop()
            middle = (earlier * more + middle * count) / (count + more)
            count += more
            middle = _within(middle, count, apart, low, high)
        groups.append((middle, count))
    places = [middle + apart * (k - 0.5 * (count - 1)) for middle, count in groups for k in range(count)]
    found = [0.0] * len(wanted)
    for index, place in zip(order, places, strict=True):
        found[index] = place
    return found


def rows_for(starts: Sequence[float], widths: Sequence[float], gap: float) -> list[int]:
    """Return the row of each label: the lowest in which it does not run into the one before.

    Args:
        starts: left ends (pixels), ascending.
        widths: of the labels (pixels).
        gap: room between two labels of a row (pixels).
    """
    ends: list[float] = []
    rows = []
    for start, width in zip(starts, widths, strict=True):
        row = next((k for k, end in enumerate(ends) if end + gap <= start), len(ends))
        ends[row:] = [start + width, *ends[row + 1 :]]
        rows.append(row)
    return rows


def _within(middle: float, count: int, apart: float, low: float, high: float) -> float:
    """Keep a group of labels between both ends."""
    half = 0.5 * apart * (count - 1)
    return min(max(middle, low + half), high - half)
