"""A closed surface of quads, the unstressed wall of a balloon: a ball, a heart, two sheets with one rim."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

POINTS_AT_ONCE = 64
"""Points that are tested at the same time for lying inside: as many times the triangles are kept."""
THINNEST = 0.03
"""Volume of the air in a balloon at the start, at least, as a share of `ClosedShape.ball_volume`."""


@dataclass(frozen=True)
class ClosedShape:
    """A closed surface whose quads all face outwards, unstressed."""

    points: Floats
    """(V, 3) float64, m."""
    quads: Ints
    """(Q, 4) int32, counter-clockwise from outside."""

    @cached_property
    def face_area(self) -> Floats:
        """Vector area of every quad, (Q, 3), m2."""
        p = self.points[self.quads]
        return np.asarray(0.5 * np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]))

    @cached_property
    def area(self) -> float:
        """Area of the wall, m2."""
        return float(np.linalg.norm(self.face_area, axis=1).sum())

    @cached_property
    def volume(self) -> float:
        """Room inside, m3: 0 of two sheets that lie on each other."""
        middle = self.points[self.quads].mean(axis=1) - self.points.mean(axis=0)
        return float((middle * self.face_area).sum() / 3.0)

    @property
    def ball_radius(self) -> float:
        """Radius of a ball with as much wall, m."""
        return math.sqrt(self.area / (4.0 * math.pi))

    @property
    def ball_volume(self) -> float:
        """Volume of that ball, m3: the most that the wall can hold without being stretched."""
        return 4.0 / 3.0 * math.pi * self.ball_radius**3

    @property
    def edge(self) -> float:
        """Side of a quad of mean size, m."""
        return math.sqrt(self.area / len(self.quads))

    @cached_property
    def box(self) -> tuple[Floats, Floats]:
        """Least and greatest corner of the box round it, (3,) each, m."""
        return self.points.min(axis=0), self.points.max(axis=0)

    @cached_property
    def size(self) -> tuple[float, float, float]:
        """Sides of the box round it, m."""
        x, y, z = self.box[1] - self.box[0]
        return float(x), float(y), float(z)

    def meets(self, other: ClosedShape) -> bool:
        """Whether the box round it and that round another one overlap."""
        (low, high), (least, most) = self.box, other.box
        return bool((low <= most).all() and (least <= high).all())

    @cached_property
    def outward(self) -> Floats:
        """Outward normal of every vertex, (V, 3): of length 1 on a flat wall, 0 at the rim of two sheets."""
        area, length = np.zeros_like(self.points), np.zeros(len(self.points))
        for corner in range(4):
            np.add.at(area, self.quads[:, corner], self.face_area)
            np.add.at(length, self.quads[:, corner], np.linalg.norm(self.face_area, axis=1))
        return np.asarray(area / length[:, None])

    def encloses(self, points: Floats) -> NDArray[np.bool_]:
        """Return which points (P, 3), m, lie inside, (P,): the wall is all round them, seen from there
        (solid angle of triangles, van Oosterom & Strackee 1983).
        """
        corners = self.points[self.quads]
        triangles = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
        inside = np.zeros(len(points), dtype=bool)
        for first in range(0, len(points), POINTS_AT_ONCE):
            a, b, c = np.moveaxis(triangles[None] - points[first : first + POINTS_AT_ONCE, None, None], 2, 0)
            la, lb, lc = (np.linalg.norm(side, axis=2) for side in (a, b, c))
            turned = (np.cross(a, b) * c).sum(axis=2)
            along = (
                la * lb * lc + (a * b).sum(axis=2) * lc + (b * c).sum(axis=2) * la + (c * a).sum(axis=2) * lb
            )
            angle = 2.0 * np.arctan2(turned, along).sum(axis=1)
            inside[first : first + POINTS_AT_ONCE] = angle > 2.0 * math.pi
        return inside

    def split(self) -> ClosedShape:
        """Return the same surface with four quads in place of each."""
        return shape_of_faces(self.points, list(self.quads), keep_quads=False)

    def parted(self) -> Floats:
        """Return the points (V, 3) with walls so far apart that there is some air between them."""
        lacking = max(THINNEST * self.ball_volume - self.volume, 0.0)
        return np.asarray(self.points + lacking / self.area * self.outward)

    @cached_property
    def start(self) -> ClosedShape:
        """The same surface with its walls parted, as a balloon is at the start."""
        return ClosedShape(self.parted(), self.quads)


def shape_of_faces(points: Floats, faces: Sequence[Ints], *, keep_quads: bool = True) -> ClosedShape:
    """Return the surface of some faces: quads as they are, others cut into quads at the middle of every face.

    `points`: (V, 3), m. `faces`: corners (k,) of each, counter-clockwise from outside.
    """
    sizes = np.array([len(face) for face in faces])
    if keep_quads and (sizes == 4).all():
        return ClosedShape(points, np.array(faces, dtype=np.int32))
    corners = np.concatenate(faces)
    face = np.repeat(np.arange(len(faces)), sizes)
    first = np.repeat(np.cumsum(sizes) - sizes, sizes)
    place = np.arange(len(corners)) - first
    following = corners[first + (place + 1) % sizes[face]]
    edges, edge = np.unique(np.sort(np.stack([corners, following], 1), axis=1), axis=0, return_inverse=True)
    edge = edge.reshape(-1)
    middles = np.zeros((len(faces), 3))
    np.add.at(middles, face, points[corners])
    all_points = np.concatenate([points, points[edges].mean(axis=1), middles / sizes[:, None]])
    before = edge[first + (place - 1) % sizes[face]]
    count = len(points)
    quads = [corners, count + edge, count + len(edges) + face, count + before]
    return ClosedShape(all_points, np.stack(quads, axis=1).astype(np.int32))
