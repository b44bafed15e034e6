"""The faces of a mesh as triangles: areas and volume at a moment, edges for ever."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

TOGETHER = 8192
"""Triangles looked at together: their numbers stay in the cache of a core, which is five times as fast."""

# Three numbers without a simple ratio: points that differ hardly ever have the same product with them.
DIRECTION = (0.5641895835, 0.3183098862, 0.7615941560)


@dataclass(frozen=True)
class Triangles:
    """Fans of the faces of a mesh."""

    corners: tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]
    """Vertex numbers (T,) of the three corners."""
    faces: NDArray[np.intp]
    """Face of each triangle (T,)."""
    sign: float
    """-1 where faces are wound clockwise, seen from outside."""

    @classmethod
    def of(cls, counts: NDArray[np.int32], indices: NDArray[np.int32], *, turned: bool) -> Triangles:
        """Cut faces of at least three corners: counts (F,) and vertex numbers (sum of counts,)."""
        starts = np.cumsum(counts) - counts
        corners, faces = [], []
        for step in range(1, int(counts.max()) - 1):
            large = np.flatnonzero(counts > step + 1)
            first = starts[large]
            corners.append(np.stack([indices[first], indices[first + step], indices[first + step + 1]]))
            faces.append(large)
        a, b, c = np.concatenate(corners, axis=1).astype(np.intp)
        return cls((a, b, c), np.concatenate(faces), -1.0 if turned else 1.0)

    def areas_and_volume(self, points: NDArray[Any]) -> tuple[NDArray[np.float64], float]:
        """Area of each face (F,) and the volume inside, negative if faces point inwards; points: (V, 3)."""
        # Rows of coordinates: NumPy gathers and multiplies them ten times as fast as rows of points.
        rows = np.ascontiguousarray(points.T, dtype=np.float64)
        # Round the middle, to keep the digits of the volume.
        rows -= rows.mean(axis=1, keepdims=True)
        areas = np.empty(len(self.faces))
        parts = [slice(start, start + TOGETHER) for start in range(0, len(areas), TOGETHER)]
        volumes = [self._part(rows, part, areas) for part in parts]
        by_face = np.asarray(np.bincount(self.faces, weights=areas), dtype=np.float64)
        return by_face, self.sign * sum(volumes)

    def _part(self, rows: NDArray[np.float64], part: slice, areas: NDArray[np.float64]) -> float:
        """Set the areas of some triangles, and return the volume between them and the origin."""
        a, b, c = ([row.take(corner[part]) for row in rows] for corner in self.corners)
        u = [there - here for here, there in zip(a, b, strict=True)]
        v = [there - here for here, there in zip(a, c, strict=True)]
        normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        six_volumes = sum(float(here @ along) for here, along in zip(a, normal, strict=True))
        squares = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]
        areas[part] = 0.5 * np.sqrt(squares)
        return six_volumes / 6.0


def coincident(points: NDArray[Any]) -> int:
    """How many of the points (V, 3) lie where another one lies."""
    x, y, z = np.ascontiguousarray(points.T, dtype=np.float64)
    # Not as a product of matrices, whose sums may depend on the row.
    along = x * DIRECTION[0] + y * DIRECTION[1] + z * DIRECTION[2]
    along.sort()
    if (along[1:] != along[:-1]).all():
        return 0
    return len(points) - len(np.unique(points, axis=0))


def edge_faults(counts: NDArray[np.int32], indices: NDArray[np.int32], points: int) -> Iterator[str]:
    """Faults in the edges: a closed, consistently wound surface has each edge once in each direction.

    Args:
        counts: corners of each face (F,), at least three.
        indices: vertex numbers (sum of counts,).
        points: number of points.
    """
    ends = np.cumsum(counts)
    following = np.arange(len(indices)) + 1
    following[ends - 1] = ends - counts
    here, there = indices.astype(np.int64), indices[following].astype(np.int64)
    if (here == there).any():
        yield f"{int((here == there).sum())} edges begin and end at one point"
    edges, uses = np.unique(here * points + there, return_counts=True)
    back = there * points + here
    if (uses > 1).any():
        yield f"{int((uses > 1).sum())} edges are used twice in one direction (winding)"
    open_edges = int((~np.isin(back, edges)).sum())
    if open_edges:
        yield f"{open_edges} open edges"
    unused = points - len(np.unique(indices))
    if unused:
        yield f"{unused} unused points"
