"""The surface of a mesh in parts, its bubbles: which points belong to each, and the volume it holds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom
from balloon_usd.stage.geometry import FAMILY

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Numbers = NDArray[np.int64]
    Points = NDArray[np.float64]

FLAT = 1e-6
"""Share of the cube of its length below which a volume counts as none."""


@dataclass(frozen=True)
class Part:
    """Some faces of a mesh, and the openings towards the others."""

    name: str
    """Of the subset; empty for the whole mesh."""
    vertices: Numbers
    """(N,) vertices of its faces."""
    triangles: Numbers
    """(T,) rows of the surface's triangles."""
    loops: tuple[Numbers, ...]
    """Vertices round each opening, against the turn of the faces beside it."""


@dataclass(frozen=True)
class Surface:
    """Faces of a mesh as triangles, and its parts, the whole first."""

    vertex_count: int
    face_count: int
    triangles: Numbers
    """(T, 3) vertices, all turning the same way seen from outside."""
    parts: tuple[Part, ...]

    def volumes(self, points: Points) -> dict[str, float]:
        """Return the volume of each part that holds any, its openings closed by fans (m3).

        Args:
            points: (V, 3) m.
        """
        # Whole columns are gathered and summed several times as fast as rows.
        columns = np.ascontiguousarray((points - points[0]).T)
        a, b, c = (columns[:, corner] for corner in np.ascontiguousarray(self.triangles.T))
        tents = _determinants(a, b, c)
        found = {}
        for part in self.parts:
            whole = len(part.triangles) == len(self.triangles)
            inside = float((tents if whole else tents[part.triangles]).sum())
            volume = abs(inside + sum(_fan(columns[:, loop]) for loop in part.loops)) / 6.0
            mine = columns[:, part.vertices]
            longest = max(float(column.max() - column.min()) for column in mine)
            # A power beyond all numbers would be an error, a product is infinite.
            if volume > FLAT * longest * longest * longest:
                found[part.name] = volume
        return found


def points_in(value: Any) -> NDArray[np.float32]:
    """Return a value as points (V, 3); none if it is of another kind, as a stage may claim."""
    found = np.asarray([] if value is None else value)
    fits = found.dtype.kind == "f" and found.ndim == 2 and found.shape[1] == 3
    return found.astype(np.float32, copy=False) if fits else np.empty((0, 3), dtype=np.float32)


def _numbers_in(value: Any) -> Numbers:
    found = np.asarray([] if value is None else value)
    fits = found.dtype.kind in "iu" and found.ndim == 1
    return found.astype(np.int64) if fits else np.empty(0, dtype=np.int64)


def surface_of(prim: Any, time: float) -> Surface | None:
    """Return the surface of a mesh as it is at a time code; None if its faces are not right."""
    mesh = UsdGeom.Mesh(prim)
    counts, corners = (
        _numbers_in(attribute.Get(time))
        for attribute in (mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr())
    )
    points = len(points_in(mesh.GetPointsAttr().Get(time)))
    wrong = not len(counts) or counts.min() < 1 or counts.sum() != len(corners)
    if wrong or corners.min() < 0 or corners.max() >= points:
        return None
    starts = np.cumsum(counts) - counts
    face = np.repeat(np.arange(len(counts)), counts)
    place = np.arange(len(corners))
    following = np.where(place + 1 < starts[face] + counts[face], place + 1, starts[face])
    fan = (place != starts[face]) & (following != starts[face])
    triangles = np.stack([corners[starts[face]], corners, corners[following]], axis=1)[fan]
    edges = np.stack([corners, corners[following]], axis=1)
    cut = _Cut(triangles, face[fan], edges, face)
    groups = {"": np.ones(len(counts), dtype=bool)}
    for name, faces in _subsets(mesh, time):
        if len(faces) and faces.min() >= 0 and faces.max() < len(counts):
            chosen = np.zeros(len(counts), dtype=bool)
            chosen[faces] = True
            groups[name] = chosen
    parts = tuple(cut.part(name, chosen) for name, chosen in groups.items())
    return Surface(points, len(counts), triangles, parts)


@dataclass(frozen=True)
class _Cut:
    """A mesh taken apart, to make parts of."""

    triangles: Numbers
    triangle_face: Numbers
    edges: Numbers
    edge_face: Numbers

    def part(self, name: str, faces: NDArray[np.bool_]) -> Part:
        edges = self.edges[faces[self.edge_face]]
        rows = np.flatnonzero(faces[self.triangle_face])
        return Part(name, np.unique(edges), rows, tuple(_openings(edges)))


def _subsets(mesh: Any, time: float) -> list[tuple[str, Numbers]]:
    """Return names and faces of the bubbles, else of all subsets of faces."""
    subsets = [s for s in UsdGeom.Subset.GetAllGeomSubsets(mesh) if s.GetElementTypeAttr().Get() == "face"]
    bubbles = [subset for subset in subsets if subset.GetFamilyNameAttr().Get() == FAMILY]
    return [
        (str(subset.GetPrim().GetName()), _numbers_in(subset.GetIndicesAttr().Get(time)))
        for subset in bubbles or subsets
    ]


def _openings(edges: Numbers) -> list[Numbers]:
    """Return the loops of directed edges (E, 2) that have no counterpart, turned round."""
    ends = edges[edges[:, 0] != edges[:, 1]]
    count = int(ends.max(initial=0)) + 1
    alone = ~np.isin(ends @ [count, 1], ends @ [1, count])
    following = {int(b): int(a) for a, b in ends[alone]}
    loops = []
    while following:
        vertex, start = following.popitem()
        loop = [vertex]
        while start in following:
            loop.append(start)
            start = following.pop(start)
        loops.append(np.array(loop))
    return loops


def _fan(loop: Points) -> float:
    """Return six times the volume between the origin and a fan round the middle of a loop (3, N)."""
    following = np.concatenate([loop[:, 1:], loop[:, :1]], axis=1)
    middle = loop.mean(axis=1, keepdims=True)
    return float(_determinants(loop, following, middle).sum())


def _determinants(a: Points, b: Points, c: Points) -> Points:
    """Return the determinant (N,) of each three vectors, columns of a, b and c (3, N)."""
    found = a[0] * (b[1] * c[2] - b[2] * c[1])
    found += a[1] * (b[2] * c[0] - b[0] * c[2])
    found += a[2] * (b[0] * c[1] - b[1] * c[0])
    return np.asarray(found)
