"""Rubber that is gone: it was cut off a balloon, or tore; frames show what is left of it at its joints."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.sizes import NECK_REACH

if TYPE_CHECKING:
    from balloon_usd.solver.body import Body
    from balloon_usd.solver.torn import Tear

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

NIB, HUB = 0.06, 0.01
"""How wide the rubber that is gone is where it begins, and in its middle, in radii of the neck: 0.15 mm on a
260, for what is folded up in other necks of the joint may lie in this one.
"""
HEIGHT = 0.1
"""How far it stands out, in radii of the neck."""
OFF_MIDDLE = 0.5
"""How far from the middle of the neck it may lie, in radii of it."""


class Stub(NamedTuple):
    """What is left where a balloon was cut: a lid on the neck, and on it a nib of what is gone.

    A mesh keeps its faces, and none of these may be without area.
    """

    vertices: Ints
    """Vertices of the balloon that are gone, (N,)."""
    neck: slice
    """Corners of the neck."""
    spokes: Floats
    """Where each vertex is across the neck, from the nib's middle, (N, 2), in radii of the neck."""
    nib: Floats
    """How far each goes along with the nib if that does not lie in the middle, (N,)."""
    height: Floats
    """How far each stands out, (N,), in radii of the neck."""
    corners: Floats
    """Where the corners of the neck are across it, (C, 2), in radii of it."""
    middle: tuple[float, float] = (0.0, 0.0)
    """Where the nib lies across the neck, in radii of it."""

    @classmethod
    def at(cls, body: Body, first: int, around: int, side: int) -> Stub:
        """Return that of all that lies on a side of a ring of a balloon: 1 beyond it, -1 before it.

        `first`, `around`: first vertex of the ring, and how many it has.
        """
        beyond = side * (body.along.astype(np.float64) - float(body.along[first]))
        neck = slice(first, first + around)
        beyond[neck] = 0.0
        vertices = np.flatnonzero(beyond > 0.0)
        flat = body.points[:, 1:].astype(np.float64)
        flat -= flat[neck].mean(axis=0)
        corners = flat[neck] / np.linalg.norm(flat[neck], axis=1, keepdims=True)
        wide = np.linalg.norm(flat, axis=1).max()
        near = np.minimum(beyond[vertices] / (NECK_REACH * body.radius), 1.0)
        share = beyond[vertices] / beyond.max()
        scale = 1.0 - (1.0 - NIB) * near - (NIB - HUB) * share
        return cls(
            vertices, neck, scale[:, None] * flat[vertices] / wide, near, side * HEIGHT * share, corners
        )

    def clear_of(self, points: NDArray[np.floating], others: Floats) -> Stub:
        """Return it with its nib where most room is from other places, (M, 3), m.

        `points`: of its balloon, (V, 3), m.
        """
        middle, axes, _ = self._frame(points)
        tried = np.concatenate([np.zeros((1, 2)), OFF_MIDDLE * self.corners])
        room = [np.linalg.norm(others - place, axis=1).min() for place in middle + tried @ axes]
        x, y = tried[int(np.argmax(room))].tolist()
        return self._replace(middle=(x, y))

    def put(self, points: NDArray[np.floating]) -> None:
        """Move its vertices among those of its balloon, (V, 3), m, in place."""
        middle, axes, out = self._frame(points)
        across = self.spokes + self.nib[:, None] * np.array(self.middle)
        points[self.vertices] = middle + across @ axes + self.height[:, None] * out

    def _frame(self, points: NDArray[np.floating]) -> tuple[Floats, Floats, Floats]:
        """Return the middle of the neck, (3,), two axes across it, (2, 3), and one along it, (3,), m."""
        neck = points[self.neck].astype(np.float64)
        middle = neck.mean(axis=0)
        axes = 2.0 / len(neck) * self.corners.T @ (neck - middle)
        out = np.cross(*axes)
        return middle, axes, out / max(math.sqrt(float(np.linalg.norm(out))), 1e-12)


class Severed(NamedTuple):
    """Rubber of a balloon that is gone."""

    balloon: int
    """Which of its sculpture's."""
    stub: Stub | Tear
