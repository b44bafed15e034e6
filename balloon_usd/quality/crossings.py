"""Edges of closed surfaces that pierce faces: an exact count, of vertices as they are given.

What only touches, or meets an edge of a face exactly, does not pierce it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.quality.boxes import overlapping_boxes
from balloon_usd.quality.orientation import sides_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Numbers = NDArray[np.int64]

CELLS = 256
"""Cells of the grid of boxes in the widest one: finer boxes are no tighter to speak of."""


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
    cell = max(float(np.ptp(points[triangles], axis=1).max(initial=0.0)), 1e-30) / CELLS
    own, others = (_boxes(points[corners] / cell) for corners in (edges, triangles))
    pairs = overlapping_boxes(*own, *others)
    around = (triangles if faces is None else faces)[pairs[:, 1]]
    ends = edges[pairs[:, 0]]
    apart = ~(ends[:, :, None] == around[:, None, :]).any(axis=(1, 2))
    return pierced_among(points, ends[apart], triangles, pairs[apart, 1])


def _boxes(places: Floats) -> tuple[Numbers, Numbers]:
    """Return the lowest and the highest cells, (N, 3) each, of what has these corners, (N, K, 3)."""
    low, high = np.floor(places.min(axis=1)), np.ceil(places.max(axis=1))
    return low.astype(np.int64), high.astype(np.int64)


def pierced_among(points: Floats, edges: Numbers, triangles: Numbers, of_these: Numbers) -> Pierced:
    """Return those of some pairs of an edge, (P, 2) vertices, and a triangle, by its index `of_these` (P,),
    of which the edge passes through the triangle.

    `points`: (V, 3) m; `triangles`: (T, 3) vertices.
    """
    a, b, c = triangles[of_these].T
    found = np.flatnonzero((a != b) & (b != c) & (c != a))
    found = found[_pierce(points[edges[found]], points[triangles[of_these[found]]])]
    ends, corners = points[edges[found]], points[triangles[of_these[found]]]
    return Pierced(edges[found], of_these[found], _reach_behind(ends, corners))


def _reach_behind(ends: Floats, corners: Floats) -> Floats:
    """Return how far edges, (N, 2, 3), reach behind the triangles that they pierce, (N, 3, 3), m."""
    a = corners[:, 0]
    normal = np.cross(corners[:, 1] - a, corners[:, 2] - a)
    behind = -np.minimum(_dot(normal, ends[:, 0] - a), _dot(normal, ends[:, 1] - a))
    return np.asarray(behind / np.linalg.norm(normal, axis=1))


def _pierce(ends: Floats, corners: Floats) -> Numbers:
    """Return which edges, (N, 2, 3), pass through triangles, (N, 3, 3)."""
    kept: Numbers = np.arange(len(ends))
    p, q, a, b, c = ends[:, 0], ends[:, 1], corners[:, 0], corners[:, 1], corners[:, 2]
    # What is left after each test is little.
    kept = kept[sides_of(a, b, c, p) * sides_of(a, b, c, q) < 0]
    first = sides_of(p[kept], q[kept], a[kept], b[kept])
    kept, first = kept[first != 0], first[first != 0]
    for u, v in ((b, c), (c, a)):
        same = sides_of(p[kept], q[kept], u[kept], v[kept]) == first
        kept, first = kept[same], first[same]
    return kept


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray((a * b).sum(axis=1))
