"""The mesh of a balloon of any closed shape: the faces of its file, split as the detail asks."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.tube_mesh import BalloonMesh

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.balloon.closed_shape import ClosedShape
    from balloon_usd.balloon.detail import Detail


def shape_mesh(surface: ClosedShape, detail: Detail) -> BalloonMesh:
    """Return the mesh of a closed surface; it is one bubble and has no rings."""
    while 4 * len(surface.quads) <= detail.shape_quads:
        surface = surface.split()
    return BalloonMesh(
        points=surface.points.astype(np.float32),
        quads=surface.quads,
        st=_printed(surface),
        quad_bubble=np.zeros(len(surface.quads), dtype=np.int32),
        along=np.zeros(len(surface.points), dtype=np.float32),
        around=0,
        ring_start=np.zeros(0, dtype=np.int32),
        ring_along=np.zeros(0),
    )


def _printed(surface: ClosedShape) -> NDArray[np.float32]:
    """Texture coordinates (Q, 4, 2): a picture printed through, across the thinnest side of the box."""
    across = int(np.argmin(surface.size))
    s, t = (axis for axis in range(3) if axis != across)
    low = surface.points.min(axis=0)
    longest = max(surface.size)
    printed = (surface.points - low)[:, [s, t]] / longest
    return np.asarray(printed[surface.quads], dtype=np.float32)
