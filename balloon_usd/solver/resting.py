"""How a rigid figure comes to stand: set down, it tips until its centre lies above what it stands on."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

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
        lever = nearest_in_hull(beside)
        size = float(np.linalg.norm(lever))
        if size < 1e-6:
            break
        # The support lies on this side of the centre: that side rises, and the other comes down.
        down = math.cos(TIPPING) * down - math.sin(TIPPING) * lever / size
        down /= np.linalg.norm(down)
    return down


def nearest_in_hull(vectors: Floats) -> Floats:
    """Return the point (3,) of the hull of vectors (N, 3) of one plane that is nearest to the origin."""
    lengths = np.linalg.norm(vectors, axis=1)
    best: Floats = vectors[int(np.argmin(lengths))]
    if len(vectors) == 1 or float(np.linalg.norm(best)) < 1e-9:
        return best
    normal = _normal(vectors)
    if normal is not None and _surrounds(vectors, normal):
        return np.zeros(3)
    pairs = np.array(list(combinations(range(len(vectors)), 2)))
    first, side = vectors[pairs[:, 0]], vectors[pairs[:, 1]] - vectors[pairs[:, 0]]
    share = -(first * side).sum(axis=1) / np.maximum((side * side).sum(axis=1), 1e-18)
    found = first + np.clip(share, 0.0, 1.0)[:, None] * side
    nearest: Floats = found[int(np.argmin(np.linalg.norm(found, axis=1)))]
    return nearest


def _normal(vectors: Floats) -> Floats | None:
    """Return the unit normal of the plane of vectors, None where they lie on one line."""
    _, sizes, axes = np.linalg.svd(vectors, full_matrices=True)
    if len(sizes) < 2 or sizes[1] < 1e-9:
        return None
    normal: Floats = axes[2]
    return normal


def _surrounds(vectors: Floats, normal: Floats) -> bool:
    """Tell whether vectors of one plane lie all round the origin: no gap between them is a half turn."""
    one = vectors[int(np.argmax(np.linalg.norm(vectors, axis=1)))]
    one = one / np.linalg.norm(one)
    angles = np.sort(np.arctan2(vectors @ np.cross(normal, one), vectors @ one))
    gaps = np.diff(np.append(angles, angles[0] + 2.0 * math.pi))
    return bool(gaps.max() < math.pi)
