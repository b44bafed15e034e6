"""The outline of a flat round balloon: half an egg from its neck to its widest ring, then half a ball.

Round balloons are dipped on forms like that, and full ones are higher than wide: of one of 10.5 inches a
width of 27 to 30 cm and a height of 35 to 40 cm, with its neck, are told.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

EGG = 3.0
"""Distance of the widest ring from where the egg would end that is cut off at the neck, in radii of the ring:
so a full one is 1.2 times as high as wide. One of 1.5 would be wider than high.
"""
LAST = 2.0 * math.pi / 3.0
"""Angle of the last ring from the neck, seen from the middle of the widest one, rad: behind it is the cap."""
_PLACES = 2001


class Outline(NamedTuple):
    """Places along a wall, from the knot to the tip."""

    along: Floats
    """Distances from the knot along the wall, (N,), m."""
    x: Floats
    """Places along the axis, (N,), m."""
    radius: Floats
    """Distances from the axis, (N,), m."""


@lru_cache(maxsize=64)
def round_outline(radius: float, neck: float, until: float = math.pi) -> Outline:
    """Return the outline of a balloon with a widest ring and a neck of some radii (m), up to an angle."""
    begin = math.asin(min(neck / radius, 1.0))
    angle = np.linspace(begin, until, _PLACES)
    x = -radius * np.where(angle < 0.5 * math.pi, EGG, 1.0) * np.cos(angle)
    out = radius * np.sin(angle)
    steps = np.hypot(np.diff(x), np.diff(out))
    return Outline(np.concatenate([[0.0], np.cumsum(steps)]), x - x[0], out)


def round_length(radius: float, neck: float) -> float:
    """Return the length of such an outline, m."""
    return float(round_outline(radius, neck).along[-1])


def round_area(radius: float, neck: float) -> float:
    """Return the area of the wall of such an outline, m2."""
    outline = round_outline(radius, neck)
    middle = 0.5 * (outline.radius[1:] + outline.radius[:-1])
    return float(2.0 * math.pi * np.sum(middle * np.diff(outline.along)))
