"""On which side of a plane points are, exactly: double precision where its error is too small to matter,
whole numbers elsewhere (Shewchuk 1997, Adaptive precision floating-point arithmetic and fast robust geometric
predicates).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

ROUNDING = 8.0 * 2.0**-53
"""Largest error of a volume in double precision, as a share of the sum of its products without their signs:
7.8e-16 and what is of higher order (Shewchuk 1997, section 4.2).
"""


def sides_of(a: Floats, b: Floats, c: Floats, points: Floats) -> NDArray[np.int64]:
    """Return on which side of the plane through a, b and c points lie: 1 where these three are seen
    counter-clockwise, -1 where clockwise, 0 in the plane; all (N, 3), result (N,).
    """
    u, v, w = b - a, c - a, points - a
    volume = np.einsum("ij,ij->i", np.cross(u, v), w)
    size = np.einsum("ij,ij->i", _crossed_sizes(np.abs(u), np.abs(v)), np.abs(w))
    sides: NDArray[np.int64] = np.sign(volume).astype(np.int64)
    for k in np.flatnonzero(np.abs(volume) < ROUNDING * size).tolist():
        sides[k] = _exact_side(*(each[k].tolist() for each in (a, b, c, points)))
    return sides


def _crossed_sizes(u: Floats, v: Floats) -> Floats:
    """Return the sums of the products in a vector product, whose factors have no signs."""
    following, last = [1, 2, 0], [2, 0, 1]
    return u[:, following] * v[:, last] + u[:, last] * v[:, following]


def _exact_side(*corners: list[float]) -> int:
    a, b, c, point = _whole_numbers(corners)
    u, v, w = ([x - y for x, y in zip(end, a, strict=True)] for end in (b, c, point))
    volume = sum(w[k] * (u[k - 2] * v[k - 1] - u[k - 1] * v[k - 2]) for k in range(3))
    return (volume > 0) - (volume < 0)


def _whole_numbers(points: Sequence[list[float]]) -> list[list[int]]:
    """Return the same points scaled so far that all coordinates are whole: floats have powers of 2 below the
    line. Python's fractions take 30 times as long.
    """
    ratios = [[x.as_integer_ratio() for x in point] for point in points]
    scale = max(below for point in ratios for _, below in point)
    return [[above * (scale // below) for above, below in point] for point in ratios]
