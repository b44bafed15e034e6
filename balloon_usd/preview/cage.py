"""The cage of a polygon mesh as wire: its edges, and which way the faces beside them look."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.preview.subdivide import CornerSum, Polygons

if TYPE_CHECKING:
    import numpy.typing as npt

    from balloon_usd.preview.subdivide import Indices, Numbers, Points


class Cage:
    """Edges of polygons, each once: topology once, points for every frame."""

    def __init__(self, face_counts: npt.ArrayLike, corners: npt.ArrayLike) -> None:
        """Find the edges.

        Args:
            face_counts: (F,) corners of each face.
            corners: (C,) vertex of each corner, face after face.
        """
        counts = np.asarray(face_counts, dtype=np.int64)
        self._used, corner = np.unique(np.asarray(corners, dtype=np.int64), return_inverse=True)
        self._polygons = Polygons.of(counts, corner)
        self._starts = np.cumsum(counts) - counts
        ends = np.sort(np.stack([corner, corner[self._polygons.following]], axis=1), axis=1)
        real = ends[:, 0] != ends[:, 1]
        keys, edge = np.unique(ends[real] @ [len(self._used), 1], return_inverse=True)
        self.edges: Numbers = np.stack(np.divmod(keys, len(self._used)), axis=1)
        """(E, 2) rows of what `used_points` returns."""
        self._beside = CornerSum.gather(edge, self._polygons.face[real], len(keys))

    @property
    def used_count(self) -> int:
        """Number U of the points that faces name."""
        return len(self._used)

    def used_points(self, points: Points) -> Points:
        """Return the points (U, 3) that faces name, of all points (V, 3)."""
        return np.asarray(points, dtype=np.float32)[self._used]

    def edge_values(self, face_values: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """Return the mean (E, 3) over the faces beside each edge of values (F, 3)."""
        return self._beside.mean(face_values)

    def edge_normals(self, used: Points) -> Points:
        """Return unit normals (E, 3) of the faces beside each edge, larger faces counting more.

        Args:
            used: (U, 3) as `used_points` returns them.
        """
        # Newell's sum holds for polygons that are not flat, and for repeated corners.
        corner = used[self._polygons.corners]
        turns = np.cross(corner, corner[self._polygons.following])
        normals = self.edge_values(np.add.reduceat(turns, self._starts, axis=0))
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        return np.asarray(normals / np.maximum(length, np.finfo(np.float32).tiny), dtype=np.float32)

    def triangles(self) -> tuple[Indices, Numbers]:
        """Return the faces as fans: rows of what `used_points` returns (T, 3), and the face of each (T,)."""
        corners, face = self._polygons.corners, self._polygons.face
        first = self._starts[face]
        here = np.arange(len(corners))
        following = self._polygons.following
        fan = np.stack([corners[first], corners, corners[following]], axis=1)
        inside = (here != first) & (following != first)
        return fan[inside].astype(np.int32), face[inside]
