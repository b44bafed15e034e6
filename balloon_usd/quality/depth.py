"""How deep vertices lie inside closed surfaces: winding numbers, and distances to the way out."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Numbers = NDArray[np.int64]

SKIN = 5.0e-5
"""Height above its own wall at which a vertex is asked whether it lies inside another wall, m."""
INSIDE = 0.5
"""Winding number from which on a place is inside."""


def deepest(points: Floats, triangles: Numbers, vertices: Numbers) -> float:
    """Return how deep the deepest of some vertices lies inside any wall, m; 0 where none does.

    A vertex is inside if the walls wind round the place just above it. Its depth is its distance from the
    nearest wall that faces it.

    Args:
        points: (V, 3) m, of closed surfaces.
        triangles: (T, 3), counter-clockwise from outside.
        vertices: those that are asked.
    """
    corners = points[triangles]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    found = 0.0
    for vertex in vertices.tolist():
        normal = area[(triangles == vertex).any(axis=1)].sum(axis=0)
        normal /= max(float(np.linalg.norm(normal)), 1e-30)
        if _winding(points[vertex] + SKIN * normal, corners) > INSIDE:
            facing = corners[area @ normal < 0.0]
            found = max(found, float(_distances(points[vertex], facing).min(initial=np.inf)))
    return found if math.isfinite(found) else 0.0


def _winding(place: Floats, corners: Floats) -> float:
    """Return how often triangles, (T, 3, 3) m, wind round a place (van Oosterom and Strackee 1983)."""
    a, b, c = (corners[:, k] - place for k in range(3))
    la, lb, lc = (np.sqrt(_dot(side, side)) for side in (a, b, c))
    over = _dot(a, np.cross(b, c))
    under = la * lb * lc + _dot(a, b) * lc + _dot(b, c) * la + _dot(c, a) * lb
    return float(np.arctan2(over, under).sum()) / (2.0 * math.pi)


def _distances(place: Floats, corners: Floats) -> Floats:
    """Return the distances of a place from triangles, (T, 3, 3) m."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    size = np.maximum(_dot(normal, normal), 1e-30)
    height = _dot(place - a, normal)
    foot = place - (height / size)[:, None] * normal
    sides = ((a, b), (b, c), (c, a))
    over = np.all([_dot(np.cross(v - u, foot - u), normal) >= 0.0 for u, v in sides], axis=0)
    beside = np.min([_from_side(place, u, v) for u, v in sides], axis=0)
    return np.asarray(np.where(over, np.abs(height) / np.sqrt(size), beside))


def _from_side(place: Floats, a: Floats, b: Floats) -> Floats:
    along = b - a
    share = _dot(place - a, along) / np.maximum(_dot(along, along), 1e-30)
    return np.asarray(np.linalg.norm(place - a - np.clip(share, 0.0, 1.0)[:, None] * along, axis=1))


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray(np.einsum("ti,ti->t", *np.broadcast_arrays(a, b)))
