"""The body of a round balloon: lip and knot bead as those of a tube, and one chamber."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.solver.latex.body import ARC_OFFSET, LatexBody, tube_body

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.balloon.tube_mesh import BalloonMesh


def round_body(
    mesh: BalloonMesh,
    rubber: Rubber,
    size: BalloonSize,
    joints: tuple[float, ...],
    guides: tuple[float, ...],
    knot_pressure: float,
) -> LatexBody:
    """Return the body of a round balloon; `joints`, `guides`: unstressed distances of rings from the knot, m.

    It is tied as a tube of the width of its neck is. It bulges all at once, so nothing of it is stretched
    beforehand.
    """
    neck = size.neck_radius, size.thickness
    tied = tube_body(mesh, rubber, *neck, (), guides, knot_pressure, parted=joints, seeded=False)
    wall = tied.thickness
    if size.heart:
        wall = wall * size.heart_wall.wall(mesh.points[mesh.quads].mean(axis=1))
    return replace(
        tied,
        thickness=wall,
        contact_arc=ARC_OFFSET / (8.0 * maxwell_state(rubber).bulged.b * size.radius),
    )
