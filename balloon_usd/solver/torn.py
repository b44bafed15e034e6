"""A wall that has torn: frames show its two rags, and no rubber between them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.ringed_faces import unit_circle
from balloon_usd.balloon.tube_mesh import TORN_ROWS, first_torn_row

if TYPE_CHECKING:
    from balloon_usd.solver.body import Body

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

THREAD = 1.0e-5
"""Radius of the thread that is left between two rags, m: no face of it is without area, and none is seen."""


class Tear(NamedTuple):
    """The rows of faces of a balloon that are gone where it has torn, and the rings between them.

    A mesh keeps its faces: two rows become a lid on each rag, the one between them a thread.
    """

    faces: Ints
    """Rows of faces, (5, around), of the balloon."""
    rings: Ints
    """The rim of one rag, four rings that are gone, and the rim of the other, (6, around) vertices of it."""

    @classmethod
    def of(cls, body: Body, faces: Ints) -> Self:
        """Return that of a bubble of a balloon; `faces`: of the bubble, in order round each ring, (F,)."""
        rows = faces.reshape(-1, body.rings[0].around)
        first = first_torn_row(len(rows))
        torn = rows[first : first + TORN_ROWS]
        corners = body.quads[torn].astype(np.int64)
        return cls(torn, np.concatenate([corners[:, :, 0], corners[-1:, :, 3]]))

    def put(self, points: NDArray[np.floating]) -> None:
        """Move its vertices among those of its balloon, (V, 3), m, in place."""
        for rim, near, far in (self.rings[:3], self.rings[:2:-1]):
            places = points[rim].astype(np.float64)
            middle = places.mean(axis=0)
            circle = THREAD * _circle(places - middle)
            points[near] = middle + 2.0 * circle
            points[far] = middle + circle


class OpenBubble(NamedTuple):
    """A bubble that has torn or was cut off, in a scene."""

    segment: int
    """Its segment."""
    vertices: Ints
    """Vertices of its wall."""


def _circle(rim: Floats) -> Floats:
    """Return a circle of radius 1 that lies as a rim does, (around, 3), m, from its middle."""
    across = np.cross(rim, np.roll(rim, -1, axis=0)).sum(axis=0)
    across /= max(float(np.linalg.norm(across)), 1.0e-18)
    first = rim[0] - rim[0] @ across * across
    first /= max(float(np.linalg.norm(first)), 1.0e-9)
    flat = unit_circle(len(rim))
    return np.asarray(flat[:, :1] * first + flat[:, 1:] * np.cross(across, first))
