"""Walls that pass through each other: how deep, and where."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from tests.inside_walls import inside_walls

if TYPE_CHECKING:
    from collections.abc import Sequence

Floats = NDArray[np.float64]

SKIN = 5.0e-5
"""Height above its own wall at which a vertex is asked whether it lies in another wall, m."""


@dataclass(frozen=True)
class Crossing:
    """The deepest place at which a wall lies inside another."""

    depth: float
    """Distance to the way out, m; 0 where no wall crosses another."""
    vertices: int
    """Vertices that lie inside another wall."""
    place: tuple[float, float, float]
    """The deepest of them, m."""


def deepest_crossing(
    meshes: Sequence[tuple[NDArray[np.float32], NDArray[np.int32]]], asked: NDArray[np.bool_] | None = None
) -> Crossing:
    """Return how deep any wall of a sculpture lies inside another wall, its own balloon's included.

    `meshes`: (points (V, 3) m, quads (Q, 4)) of every balloon, closed surfaces; `asked`: which of all their
    vertices are looked at, all of them when absent. A vertex is inside another
    wall when the point just above it has a winding number of 1 or more; its depth is the distance to the
    nearest wall that faces it.
    """
    points, triangles = _triangles(meshes)
    corners = points[triangles]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal = np.zeros_like(points)
    for k in range(3):
        np.add.at(normal, triangles[:, k], area)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-30)[:, None]
    within = inside_walls(points + SKIN * normal, points, triangles)
    inside = np.flatnonzero(within if asked is None else within & asked)
    worst, place = 0.0, points[0]
    for i in inside:
        # Its own faces count: where a wall is creased, as in a neck, it lies on itself and crosses nothing.
        facing = area @ normal[i] < 0.0
        depth = _distance(points[i], corners[facing]) if facing.any() else 0.0
        if depth > worst:
            worst, place = depth, points[i]
    return Crossing(worst, len(inside), (float(place[0]), float(place[1]), float(place[2])))


def _triangles(
    meshes: Sequence[tuple[NDArray[np.float32], NDArray[np.int32]]],
) -> tuple[Floats, NDArray[np.int64]]:
    start = 0
    points: list[Floats] = []
    triangles: list[NDArray[np.int64]] = []
    for vertices, quads in meshes:
        numbers = quads.astype(np.int64) + start
        triangles.extend((numbers[:, :3], numbers[:, [0, 2, 3]]))
        points.append(vertices.astype(np.float64))
        start += len(vertices)
    return np.concatenate(points), np.concatenate(triangles)


def _distance(p: Floats, corners: Floats) -> float:
    """Distance from a point to the nearest of some triangles (T, 3, 3), m."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    edges = [_to_segment(p, a, b), _to_segment(p, b, c), _to_segment(p, c, a)]
    normal = np.cross(b - a, c - a)
    size = np.maximum(np.einsum("ti,ti->t", normal, normal), 1e-30)
    height = np.einsum("ti,ti->t", p - a, normal)
    foot = p - (height / size)[:, None] * normal
    over = np.ones(len(a), dtype=bool)
    for u, v in ((a, b), (b, c), (c, a)):
        over &= np.einsum("ti,ti->t", np.cross(v - u, foot - u), normal) >= 0.0
    plane = np.where(over, np.abs(height) / np.sqrt(size), np.inf)
    return float(np.minimum(np.min(edges, axis=0), plane).min())


def _to_segment(p: Floats, a: Floats, b: Floats) -> Floats:
    along = b - a
    share = np.einsum("ti,ti->t", p - a, along) / np.maximum(np.einsum("ti,ti->t", along, along), 1e-30)
    foot = a + np.clip(share, 0.0, 1.0)[:, None] * along
    return np.asarray(np.linalg.norm(p - foot, axis=1))
