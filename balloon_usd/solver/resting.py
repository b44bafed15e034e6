"""How a rigid figure comes to stand: set down, it tips until its centre lies above what it stands on."""

from __future__ import annotations

import math
from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Vector = tuple[float, float, float]

TOUCHING = 4.0e-4
"""Points that lie no higher than this above the lowest one touch the ground, m."""
TIPPING = math.radians(0.1)
"""Turn of one step of tipping."""
STEPS = 3600
"""Steps after which tipping ends anyway."""


UPRIGHT = math.radians(15.0)
"""Tip that is taken as it comes; where a figure tips farther, hands try to set it down otherwise."""
TRIED = (math.radians(8.0), math.radians(16.0), math.radians(24.0), math.radians(32.0))
"""How far hands lean it when they try."""
TRIED_WAYS = 8
"""Directions in which they lean it."""


def standing_direction(points: Floats, centre: Floats, down: Floats) -> Floats:
    """Return the direction (3,) of the figure that points down when hands have made it stand, as a unit
    vector: of the poses in which it rests that nearest to `down`.

    `points`, `centre`, `down`: as of `resting_direction`.
    """
    found = resting_direction(points, centre, down)
    if float(found @ down) >= math.cos(UPRIGHT):
        return found
    beside = np.linalg.svd(down[None])[2][1:]
    ways = np.linspace(0.0, 2.0 * math.pi, TRIED_WAYS, endpoint=False)
    for lean in TRIED:
        for way in ways:
            across = math.cos(way) * beside[0] + math.sin(way) * beside[1]
            leaning = math.cos(lean) * down + math.sin(lean) * across
            tried = resting_direction(points, centre, leaning)
            if float(tried @ down) > float(found @ down):
                found = tried
    return found


def resting_direction(points: Floats, centre: Floats, down: Floats) -> Floats:
    """Return the direction (3,) of the figure that points down when it rests, as a unit vector.

    `points`: of its walls, (N, 3), m; `centre`: of its mass, (3,), m; `down`: unit direction, (3,), that
    points down when it is set on the ground. It tips about the points that touch, each time a little, as a
    body does that falls so slowly that it does not swing.
    """
    arms = points - centre
    for _ in range(STEPS):
        depth = arms @ down
        touching = arms[depth > depth.max() - TOUCHING]
        beside = touching - np.outer(touching @ down, down)
        lever = nearest_in_hull(beside, down)
        size = float(np.linalg.norm(lever))
        if size < 1e-6:
            break
        # The support lies on this side of the centre: that side rises, and the other comes down.
        down = math.cos(TIPPING) * down - math.sin(TIPPING) * lever / size
        down /= np.linalg.norm(down)
    return down


def nearest_in_hull(vectors: Floats, normal: Floats) -> Floats:
    """Return the point (3,) of the hull of vectors (N, 3) of one plane that is nearest to the origin.

    `normal`: of the plane, (3,), a unit vector. Plain numbers: of four vectors a seventh of the time of
    arrays.
    """
    corners: list[Vector] = [(x, y, z) for x, y, z in vectors.tolist()]
    lengths = [math.sqrt(_dot(corner, corner)) for corner in corners]
    shortest = min(lengths)
    best = corners[lengths.index(shortest)]
    if len(corners) == 1 or shortest < 1e-9:
        return np.array(best)
    if _surrounds(corners, lengths, normal):
        return np.zeros(3)
    for first, second in combinations(corners, 2):
        found = _nearest_between(first, second)
        if (length := math.sqrt(_dot(found, found))) < shortest:
            best, shortest = found, length
    return np.array(best)


def _nearest_between(first: Vector, second: Vector) -> Vector:
    """Return the point of the line between two points that is nearest to the origin."""
    ax, ay, az = first
    sx, sy, sz = side = second[0] - ax, second[1] - ay, second[2] - az
    share = min(max(-_dot(first, side) / max(_dot(side, side), 1e-18), 0.0), 1.0)
    return ax + share * sx, ay + share * sy, az + share * sz


def _dot(one: Vector, other: Vector) -> float:
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]


def _surrounds(corners: list[Vector], lengths: list[float], normal: Floats) -> bool:
    """Tell whether vectors of one plane lie all round the origin: no gap between them is a half turn."""
    x, y, z = corners[lengths.index(max(lengths))]
    a, b, c = normal.tolist()
    beside = (b * z - c * y, c * x - a * z, a * y - b * x)
    across = [_dot(corner, beside) for corner in corners]
    if max(map(abs, across)) < 1e-9 * max(lengths):
        return False
    angles = sorted(
        math.atan2(far, _dot(corner, (x, y, z))) for far, corner in zip(across, corners, strict=True)
    )
    gaps = [after - before for before, after in pairwise(angles)]
    return max(*gaps, angles[0] + 2.0 * math.pi - angles[-1]) < math.pi
