"""What was cut off a balloon: frames show it snap into the joint at which it hung."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.sizes import NECK_REACH

if TYPE_CHECKING:
    from balloon_usd.solver.body import Body

Floats = NDArray[np.float64]

STUB = 0.1
"""How far what is left stands out of the neck, in radii of the neck."""
NARROWED, HUB = 0.25, 0.05
"""How wide it is there, in radii of the neck, where the rubber begins that is not folded up in the neck, and
in its middle: the wider, the more of what is folded up in other necks of the joint goes through it.
"""


class Stub(NamedTuple):
    """What is left at a neck where a balloon was cut: a lid on it, of the rubber that is gone.

    A mesh keeps its faces, and none of these may be without area.
    """

    vertices: NDArray[np.int64]
    """Vertices of the balloon that are gone, (N,)."""
    neck: slice
    """Corners of the neck."""
    spokes: Floats
    """Where each of these vertices is in the lid, along both axes of the neck, in radii of it, (N, 2)."""
    height: Floats
    """How far each stands out of it, (N,), in radii of it."""
    corners: Floats
    """Where the corners of the neck are along its axes, (C, 2), in radii of it."""

    @classmethod
    def at(cls, body: Body, first: int, around: int, side: int) -> Stub:
        """Return that of all that lies on a side of a ring of a balloon: 1 beyond it, -1 before it.

        `first`, `around`: first vertex of the ring, and how many it has.
        """
        beyond = side * (body.along.astype(np.float64) - float(body.along[first]))
        neck = slice(first, first + around)
        beyond[neck] = 0.0
        vertices = np.flatnonzero(beyond > 0.0)
        share = beyond[vertices] / beyond.max()
        flat = body.points[:, 1:].astype(np.float64)
        flat -= flat[neck].mean(axis=0)
        corners = flat[neck] / np.linalg.norm(flat[neck], axis=1, keepdims=True)
        wide = np.linalg.norm(flat, axis=1).max()
        near = np.minimum(beyond[vertices] / (NECK_REACH * body.radius), 1.0)
        scale = 1.0 - (1.0 - NARROWED) * near - (NARROWED - HUB) * share
        spokes = scale[:, None] * flat[vertices] / wide
        return cls(vertices, neck, spokes, side * STUB * share, corners)

    def places(self, points: NDArray[np.floating]) -> Floats:
        """Return where its vertices are, (N, 3), m, among those of its balloon, (V, 3), m."""
        neck = points[self.neck].astype(np.float64)
        middle = neck.mean(axis=0)
        axes = 2.0 / len(neck) * self.corners.T @ (neck - middle)
        out = np.cross(*axes)
        out /= max(float(np.sqrt(np.linalg.norm(out))), 1e-12)
        places: Floats = middle + self.spokes @ axes + self.height[:, None] * out
        return places


class Severed(NamedTuple):
    """Rubber of a balloon that is being cut off, or is gone."""

    balloon: int
    """Which of its sculpture's."""
    stub: Stub
    share: float
    """Of the cut that is done."""

    def put(self, points: NDArray[np.floating]) -> None:
        """Move its vertices among those of its balloon, (V, 3), m, in place."""
        own = self.stub.vertices
        points[own] = (1.0 - self.share) * points[own] + self.share * self.stub.places(points)
