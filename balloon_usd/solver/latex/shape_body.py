"""The body of a balloon of any closed shape: one chamber, and nothing for hands to hold."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.closed_shape import ClosedShape
from balloon_usd.solver.latex.body import LatexBody

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.tube_mesh import BalloonMesh

NEIGHBOURS = 2.0
"""Distance within which its wall never meets itself, in sides of a face: it is one fold there."""


def shape_body(mesh: BalloonMesh, rubber: Rubber, thickness: float) -> LatexBody:
    """Return the body of a closed surface, its walls a little apart at the start; `thickness` in m."""
    surface = ClosedShape(mesh.points.astype(np.float64), mesh.quads)
    near = NEIGHBOURS * surface.edge
    start = surface.start
    return LatexBody(
        points=start.points.astype(np.float32),
        rest=surface.points,
        quads=mesh.quads,
        thickness=np.full(len(mesh.quads), thickness),
        rubber=rubber,
        worked=np.zeros(len(mesh.quads)),
        radius=near,
        along=mesh.along,
        # A ring of one vertex has no radius: walls meet from outside only, not the far side of their balloon.
        mesh_rings=((0, 1),),
        vertex_ring=np.zeros(len(mesh.points), dtype=np.int32),
        rings=(),
        segment_ends=np.array([len(mesh.quads)], dtype=np.int32),
        gauge=np.zeros(1),
        vented=(),
        inlet=0,
        neck_radius=near,
        place=mesh.points,
        gap=2.0 * start.volume / start.area,
    )
