"""Catmull-Clark subdivision of polygon cages in NumPy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Points = npt.NDArray[np.float32]
Indices = npt.NDArray[np.int32]
Numbers = npt.NDArray[np.int64]


@dataclass(frozen=True)
class CornerSum:
    """Averages rows of an array into fewer rows: a sparse matrix in compressed rows."""

    columns: Numbers
    """(N,) source row of each entry."""
    starts: Numbers
    """(R,) first entry of each row; no row is empty."""
    counts: npt.NDArray[np.float32]
    """(R, 1) entries of each row."""

    @classmethod
    def gather(cls, rows: Numbers, columns: Numbers, count: int) -> CornerSum:
        """Group `columns` by `rows`, numbers below `count`, each of which must occur."""
        order = np.argsort(rows, kind="stable")
        counts = np.bincount(rows, minlength=count)
        starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
        return cls(columns[order], starts, counts.astype(np.float32)[:, None])

    def mean(self, values: Points) -> Points:
        """Return the mean of each row's source rows, (R, 3)."""
        total = np.add.reduceat(values[self.columns], self.starts, axis=0)
        return np.asarray(total / self.counts, dtype=np.float32)


@dataclass(frozen=True)
class SubdivisionStep:
    """One level for one topology (Catmull & Clark 1978; boundaries as USD's edgeAndCorner)."""

    quads: Indices
    """(Q, 4) refined faces; those of one parent face are consecutive."""
    parent: Numbers
    """(Q,) parent face of each refined face."""
    faces: CornerSum
    edges: Numbers
    """(E, 2) end points."""
    edge_faces: Numbers
    """(E, 2) faces beside each edge, the same twice on a boundary."""
    vertex_faces: CornerSum
    vertex_edges: CornerSum
    boundary_edges: npt.NDArray[np.bool_]
    """(E,) whether only one face is beside an edge."""
    boundary_vertices: Numbers
    boundary_neighbours: Numbers
    """(B, 2) the two neighbours of each boundary vertex along the boundary."""

    def refine(self, points: Points) -> Points:
        """Return the refined rows of `points` (V, 3): moved vertices, then edge points, then face points."""
        face_points = self.faces.mean(points)
        middles = points[self.edges].mean(axis=1)
        edge_points = 0.5 * (middles + face_points[self.edge_faces].mean(axis=1))
        edge_points[self.boundary_edges] = middles[self.boundary_edges]
        valence = self.vertex_edges.counts
        smooth = self.vertex_faces.mean(face_points) + 2.0 * self.vertex_edges.mean(middles)
        vertex_points = (smooth + (valence - 3.0) * points) / valence
        ends = points[self.boundary_neighbours].sum(axis=1)
        vertex_points[self.boundary_vertices] = 0.75 * points[self.boundary_vertices] + 0.125 * ends
        corners = self.vertex_faces.counts[:, 0] == 1.0
        vertex_points[corners] = points[corners]
        return np.concatenate([vertex_points, edge_points, face_points]).astype(np.float32)


@dataclass(frozen=True)
class Polygons:
    """Faces as one list of corners, with what each corner belongs to."""

    corners: Numbers
    """(C,) vertex of each corner, face after face."""
    face: Numbers
    """(C,) face of each corner."""
    following: Numbers
    """(C,) corner after each corner round its face."""
    preceding: Numbers
    """(C,) corner before each corner round its face."""

    @classmethod
    def of(cls, face_counts: Numbers, corners: Numbers) -> Polygons:
        """Link the corners of faces with `face_counts` (F,) corners each."""
        first = np.repeat(np.cumsum(face_counts) - face_counts, face_counts)
        size = np.repeat(face_counts, face_counts)
        place = np.arange(len(corners)) - first
        face = np.repeat(np.arange(len(face_counts)), face_counts)
        return cls(corners, face, first + (place + 1) % size, first + (place - 1) % size)


def subdivision_step(face_counts: Numbers, corners: Numbers, count: int) -> SubdivisionStep:
    """Prepare one level for a polygon mesh.

    Args:
        face_counts: (F,) corners of each face.
        corners: (C,) vertex of each corner, face after face.
        count: number of vertices; every vertex belongs to a face.
    """
    polygons = Polygons.of(face_counts, corners)
    face = polygons.face
    ends = np.sort(np.stack([corners, corners[polygons.following]], axis=1), axis=1)
    keys, first_use, edge = np.unique(ends @ [count, 1], return_index=True, return_inverse=True)
    edges = np.stack(np.divmod(keys, count), axis=1)
    last_use = np.zeros(len(edges), dtype=np.int64)
    last_use[edge] = np.arange(len(corners))
    boundary = np.bincount(edge, minlength=len(edges)) == 1
    middles = count + edge
    quads = np.stack([corners, middles, count + len(edges) + face, middles[polygons.preceding]], axis=1)
    vertices, neighbours = _along_boundary(edges[boundary], count)
    return SubdivisionStep(
        quads=quads.astype(np.int32),
        parent=face,
        faces=CornerSum.gather(face, corners, len(face_counts)),
        edges=edges,
        edge_faces=np.stack([face[first_use], face[last_use]], axis=1),
        vertex_faces=CornerSum.gather(corners, face, count),
        vertex_edges=CornerSum.gather(edges.ravel(), np.repeat(np.arange(len(edges)), 2), count),
        boundary_edges=boundary,
        boundary_vertices=vertices,
        boundary_neighbours=neighbours,
    )


def _along_boundary(edges: Numbers, count: int) -> tuple[Numbers, Numbers]:
    """Return the vertices with exactly two boundary edges (B,) and their neighbours along them (B, 2)."""
    ends = np.concatenate([edges[:, 0], edges[:, 1]])
    others = np.concatenate([edges[:, 1], edges[:, 0]])
    order = np.argsort(ends, kind="stable")
    degree = np.bincount(ends, minlength=count)
    regular = np.flatnonzero(degree == 2)
    starts = np.cumsum(degree) - degree
    neighbours = others[order]
    return regular, np.stack([neighbours[starts[regular]], neighbours[starts[regular] + 1]], axis=1)
