"""Axes: round numbers that cover what is drawn, and where they lie on the paper."""

from __future__ import annotations

import math
from dataclasses import dataclass

STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)
"""Distances between marks, in powers of ten."""
ROUND_OFF = 1e-9


@dataclass(frozen=True)
class Axis:
    """A scale from values to pixels."""

    low: float
    high: float
    ticks: tuple[float, ...]
    """Round values between both ends."""
    start: float
    """Pixel of `low`."""
    end: float
    """Pixel of `high`; smaller than `start` on an axis that rises."""

    def place(self, value: float) -> float:
        """Return the pixel of a value; what lies beyond the ends stays at them."""
        share = (value - self.low) / (self.high - self.low)
        return self.start + min(max(share, 0.0), 1.0) * (self.end - self.start)

    def text(self, tick: float) -> str:
        """Return a tick as it is written, all with the same number of digits."""
        step = self.ticks[1] - self.ticks[0] if len(self.ticks) > 1 else 1.0
        return f"{tick:.{_digits(step)}f}"


def value_axis(low: float, high: float, start: float, end: float, count: int = 5) -> Axis:
    """Return an axis whose ends are round, with about `count` marks, for values from `low` to `high`."""
    if not high - low > ROUND_OFF * max(abs(low), abs(high), ROUND_OFF):
        high = low + (abs(low) or 1.0)
    step = _round_step((high - low) / count)
    first, last = math.floor(low / step + ROUND_OFF), math.ceil(high / step - ROUND_OFF)
    ticks = tuple(step * k for k in range(first, last + 1))
    return Axis(ticks[0], ticks[-1], ticks, start, end)


def time_axis(low: float, high: float, start: float, end: float, count: int = 12) -> Axis:
    """Return an axis that ends where the values do, with round marks between."""
    step = _round_step((high - low) / count)
    first, last = math.ceil(low / step - ROUND_OFF), math.floor(high / step + ROUND_OFF)
    return Axis(low, high, tuple(step * k for k in range(first, last + 1)), start, end)


def _round_step(least: float) -> float:
    power = 10.0 ** math.floor(math.log10(least))
    return next(power * step for step in STEPS if power * step >= least * (1.0 - ROUND_OFF))


def _digits(step: float) -> int:
    """Digits after the point that a multiple of a round step needs."""
    return next((n for n in range(9) if abs(round(step, n) - step) < ROUND_OFF * step), 9)
