"""The smooth surface that is drawn in place of a coarse cage."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.preview.subdivide import CornerSum, Polygons, SubdivisionStep, subdivision_step

if TYPE_CHECKING:
    import numpy.typing as npt

    from balloon_usd.preview.subdivide import Indices, Numbers, Points

ENOUGH_QUADS = 48_000
"""Faces beyond which one more level of subdivision no longer shows at preview size."""
MOST_LEVELS = 2


class SmoothSurface:
    """A polygon cage prepared for subdivision: topology once, points for every frame."""

    def __init__(self, face_counts: npt.ArrayLike, corners: npt.ArrayLike, levels: int | None = None) -> None:
        """Prepare the cage.

        Args:
            face_counts: (F,) corners of each face.
            corners: (C,) vertex of each corner, face after face.
            levels: subdivision levels, at least 1; chosen by the number of faces when None.
        """
        counts, corner = _without_repeated_corners(
            np.asarray(face_counts, dtype=np.int64), np.asarray(corners, dtype=np.int64)
        )
        self._used, corner = np.unique(corner, return_inverse=True)
        self._steps: list[SubdivisionStep] = []
        self.cage_face: Numbers = np.arange(len(counts))
        count = len(self._used)
        for _ in range(levels or levels_for(len(corner))):
            step = subdivision_step(counts, corner, count)
            count += len(step.edges) + len(counts)
            counts, corner = np.full(len(step.quads), 4), step.quads.astype(np.int64).ravel()
            self.cage_face = self.cage_face[step.parent]
            self._steps.append(step)
        self.quads: Indices = self._steps[-1].quads
        self.vertex_count = count
        self._vertex_quads = CornerSum.gather(corner, np.repeat(np.arange(len(self.quads)), 4), count)

    @property
    def cage_count(self) -> int:
        """Vertices of the cage; they are the first so many of the refined ones."""
        return len(self._used)

    def refine(self, points: Points) -> Points:
        """Return the refined points (vertex_count, 3) of cage points (V, 3)."""
        return self.spread(self.used_points(points))

    def used_points(self, points: Points) -> Points:
        """Return the points (cage_count, 3) that faces name, of all points (V, 3)."""
        return np.asarray(points, dtype=np.float32)[self._used]

    def spread(self, values: Points) -> Points:
        """Carry values (cage_count, 3) of the cage smoothly to all refined vertices (vertex_count, 3)."""
        for step in self._steps:
            values = step.refine(values)
        return values

    def normals(self, refined: Points) -> Points:
        """Return unit vertex normals (vertex_count, 3), area weighted."""
        corner = refined[self.quads]
        area = np.cross(corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1])
        normal = self._vertex_quads.mean(area)
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        return np.asarray(normal / np.maximum(length, np.finfo(np.float32).tiny), dtype=np.float32)


def levels_for(corner_count: int) -> int:
    """Return the subdivision levels that make a cage with so many corners look round."""
    return MOST_LEVELS if 4 * corner_count <= ENOUGH_QUADS else 1


def _without_repeated_corners(counts: Numbers, corners: Numbers) -> tuple[Numbers, Numbers]:
    """Turn quads with a repeated corner, as caps have them, into triangles."""
    polygons = Polygons.of(counts, corners)
    kept = corners != corners[polygons.following]
    return np.bincount(polygons.face[kept], minlength=len(counts)), corners[kept]
