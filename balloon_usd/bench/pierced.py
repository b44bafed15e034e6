"""Edges of a triangle mesh that pierce its triangles."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from balloon_usd.bench.pinch_task import Floats, Ints

BLOCK = 256
"""Edges taken at a time: bounds the memory of the pairs."""


def pierced_triangles(points: Floats, triangles: Ints) -> int:
    """Return how many pairs there are of an edge and a triangle that it passes through, of no common vertex.

    `points`: (V, 3), m. `triangles`: (T, 3).
    """
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges = np.unique(sides, axis=0)
    edges = edges[np.argsort(points[edges, 0].min(axis=1))]
    low, high = points[triangles].min(axis=1), points[triangles].max(axis=1)
    found = 0
    for begin in range(0, len(edges), BLOCK):
        block = edges[begin : begin + BLOCK]
        least, most = points[block].min(axis=1), points[block].max(axis=1)
        # Sorted along x, a block of edges has few triangles beside it.
        beside = np.flatnonzero((low[:, 0] <= most[:, 0].max()) & (high[:, 0] >= least[:, 0].min()))
        over = (low[None, beside] <= most[:, None]) & (high[None, beside] >= least[:, None])
        e, t = np.nonzero(over.all(axis=2))
        pairs, corners = block[e], triangles[beside[t]]
        apart = ~(pairs[:, :, None] == corners[:, None, :]).any(axis=(1, 2))
        found += int(_pierces(points[pairs[apart]], points[corners[apart]]).sum())
    return found


def _pierces(ends: Floats, corners: Floats) -> Floats:
    """Whether edges, (N, 2, 3), pass through triangles, (N, 3, 3): signs of tetrahedra, (N,)."""
    p, q = ends[:, 0], ends[:, 1]
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    parted = _tetrahedron(a, b, c, p) * _tetrahedron(a, b, c, q) < 0.0
    around = np.stack([_tetrahedron(p, q, a, b), _tetrahedron(p, q, b, c), _tetrahedron(p, q, c, a)])
    return np.asarray(parted & ((around > 0.0).all(axis=0) | (around < 0.0).all(axis=0)))


def _tetrahedron(a: Floats, b: Floats, c: Floats, d: Floats) -> Floats:
    """Six times the signed volumes of tetrahedra, (N,), m3."""
    return np.asarray(np.einsum("ni,ni->n", np.cross(b - a, c - a), d - a))
