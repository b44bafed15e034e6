"""Edges that pierce faces of one surface, frame after frame, on a device: the numbers of `pierced_triangles`.

A thirtieth of the time of NumPy on one CPU core, but for the import of Warp. The tree of boxes is built once
and refitted to every frame: tubes fold up, but what is next to each other in their rubber stays so.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import warp as wp

from balloon_usd.quality.crossings import Pierced, pierced_among
from balloon_usd.quality.kernels.piercing import Surface, box_faces, find_pierced
from balloon_usd.quality.walls import halves

if TYPE_CHECKING:
    from typing import Any

    from numpy.typing import NDArray

    Numbers = NDArray[np.int64]

ROOM = 1024
"""Pairs for which there is room at first."""


class PiercedSearch:
    """Searches a surface of quads; a triangle is a quad whose last corner is there twice."""

    def __init__(self, quads: Numbers, device: str = "cpu") -> None:
        """Get ready on a device of Warp; `quads`: faces, (F, 4) vertices, counter-clockwise from outside."""
        self._device = device
        self._triangles = halves(quads)
        self._edges, owned, self._rank = _owned_edges(self._triangles)
        self._surface: Any = Surface()
        self._surface.quads = self._integers(quads, wp.vec4i)
        self._surface.edges = self._integers(self._edges, wp.vec2i)
        self._surface.owned = self._integers(owned, wp.vec2i)
        self._faces = len(quads)
        self._lows, self._highs = (wp.zeros(self._faces, dtype=wp.vec3, device=device) for _ in range(2))
        self._count = wp.zeros(1, dtype=wp.int32, device=device)
        self._found = wp.zeros(ROOM, dtype=wp.vec2i, device=device)
        self._tree: wp.Bvh | None = None

    def find(self, points: NDArray[np.float32] | wp.array[wp.vec3]) -> Pierced:
        """Return what `pierced_triangles` returns for a frame, its order included.

        Args:
            points: (V, 3) m, finite numbers; float32 in NumPy, or `wp.vec3` on the device of this search.
        """
        if isinstance(points, np.ndarray):
            places = np.ascontiguousarray(points)
            points = wp.array(places, dtype=wp.vec3, device=self._device, copy=False)
        else:
            places = points.numpy()
        self._launch(box_faces, self._faces, points, self._surface, self._lows, self._highs)
        if self._tree is None:
            self._tree = wp.Bvh(self._lows, self._highs)
        else:
            self._tree.refit()
        pairs = self._pairs(self._tree, points)
        pairs = pairs[np.lexsort((pairs[:, 1], self._rank[pairs[:, 0]]))]
        return pierced_among(
            places.astype(np.float64), self._edges[pairs[:, 0]], self._triangles, pairs[:, 1]
        )

    def _pairs(self, tree: wp.Bvh, points: Any) -> Numbers:
        """Return the pairs that may be pierced, (P, 2) numbers of an edge and a triangle, in any order."""
        while True:
            self._count.zero_()
            told = (tree.id, self._lows, self._highs, points, self._surface, self._count, self._found)
            self._launch(find_pierced, self._faces, *told)
            count = int(self._count.numpy()[0])
            if count <= len(self._found):
                return np.asarray(self._found[:count].numpy(), dtype=np.int64) if count else _none()
            self._found = wp.zeros(2 * count, dtype=wp.vec2i, device=self._device)

    def _launch(self, kernel: Any, threads: int, *arguments: Any) -> None:
        wp.launch(kernel, threads, list(arguments), device=self._device)

    def _integers(self, values: Numbers, kind: Any) -> Any:
        return wp.array(values.astype(np.int32), dtype=kind, device=self._device)


def _none() -> Numbers:
    return np.zeros((0, 2), dtype=np.int64)


def _owned_edges(triangles: Numbers) -> tuple[Numbers, Numbers, Numbers]:
    """Return the edges (E, 2) by the face that owns them, the range of each face, and their numbers.

    Those are the numbers of the edges in the order of their vertices, in which `pierced_triangles` has them.
    """
    faces = len(triangles) // 2
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, first = np.unique(sides, axis=0, return_index=True)
    owner = first // 3 % faces
    order = np.argsort(owner, kind="stable")
    ends = np.searchsorted(owner[order], np.arange(faces + 1))
    return edges[order], np.stack([ends[:-1], ends[1:]], axis=1), order
