"""Edges of closed surfaces that pierce faces: an exact count.

Vertices are rounded to a lattice on which all orientation tests are exact in integers of 64 bits. Its unit is
about 2^-20 of twice the widest box round a face: 30 nanometres in balloons, where single precision has 60 a
metre from the origin. What only touches, or meets an edge of a face exactly, does not pierce it.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.quality.boxes import overlapping_boxes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Numbers = NDArray[np.int64]

BITS = 20
"""Of a coordinate's difference: products of three, and their sum, have to fit 63 bits."""


class Pierced(NamedTuple):
    """Pairs of an edge and a triangle that it passes through."""

    edges: Numbers
    """Ends of the edges, (P, 2) vertices."""
    triangles: Numbers
    """Index of the triangles, (P,)."""
    behind: Floats
    """How far an end of the edge is behind the triangle's plane, (P,) m."""


def pierced_triangles(points: Floats, triangles: Numbers, faces: Numbers | None = None) -> Pierced:
    """Return all pairs of an edge and a triangle that it passes through, neighbours left out.

    Args:
        points: (V, 3) m.
        triangles: (T, 3) vertices, counter-clockwise from outside.
        faces: polygon of each triangle, (T, K) vertices: an edge that shares a vertex with it is its
            neighbour; by default the triangle itself.
    """
    triangles = triangles.astype(np.int64)
    edges = np.unique(np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
    unit = lattice_unit(float(np.ptp(points[triangles], axis=1).max(initial=0.0)))
    places = np.rint(points / unit).astype(np.int64)
    spans, corners = places[edges], places[triangles]
    pairs = overlapping_boxes(spans.min(axis=1), spans.max(axis=1), corners.min(axis=1), corners.max(axis=1))
    around = (triangles if faces is None else faces)[pairs[:, 1]]
    ends = edges[pairs[:, 0]]
    apart = ~(ends[:, :, None] == around[:, None, :]).any(axis=(1, 2))
    pairs = pairs[apart]
    pairs = pairs[_pierce(spans[pairs[:, 0]], corners[pairs[:, 1]])]
    behind = reach_behind(spans[pairs[:, 0]], corners[pairs[:, 1]])
    return Pierced(edges[pairs[:, 0]], pairs[:, 1], behind * unit)


def lattice_unit(widest: float) -> float:
    """Return the unit of the lattice, m: a power of two, so that most coordinates only change their scale.

    `widest`: longest side of the boxes round all triangles, m.
    """
    # Boxes that overlap are no farther apart than both are wide; rounding moves each end by half a unit.
    return math.ldexp(1.0, math.ceil(math.log2(max(2.0 * widest, 1e-30) * (1.0 + 2.0**-BITS * 8.0))) - BITS)


def reach_behind(ends: Numbers, corners: Numbers) -> Floats:
    """Return how far edges, (N, 2, 3), reach behind the triangles that they pierce, (N, 3, 3), in units."""
    a = corners[:, 0]
    normal = np.cross(corners[:, 1] - a, corners[:, 2] - a)
    behind = -np.minimum(_dot(normal, ends[:, 0] - a), _dot(normal, ends[:, 1] - a)).astype(np.float64)
    return np.asarray(behind / np.linalg.norm(normal.astype(np.float64), axis=1))


def _pierce(ends: Numbers, corners: Numbers) -> NDArray[np.bool_]:
    """Tell which edges, (N, 2, 3), pass through triangles, (N, 3, 3)."""
    p, q = ends[:, 0], ends[:, 1]
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    over_p, over_q = _dot(normal, p - a), _dot(normal, q - a)
    parted = np.flatnonzero(np.sign(over_p) * np.sign(over_q) < 0)
    p, q, a, b, c = (each[parted] for each in (p, q, a, b, c))
    along = q - p
    sides = [np.sign(_dot(np.cross(along, u - p), v - p)) for u, v in ((a, b), (b, c), (c, a))]
    through = (sides[0] != 0) & (sides[0] == sides[1]) & (sides[1] == sides[2])
    found = np.zeros(len(ends), dtype=np.bool_)
    found[parted[through]] = True
    return found


def _dot(a: Numbers, b: Numbers) -> Numbers:
    return np.asarray((a * b).sum(axis=1))
