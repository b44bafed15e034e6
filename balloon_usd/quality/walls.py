"""The walls of a sculpture as one surface: triangles, bubbles, and the necks of its joints."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.balloon.sizes import NECK_REACH
from balloon_usd.quality.joints import joints_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan, Strip

    Numbers = NDArray[np.int64]

CAPSULE_NECK_REACH = 0.25
"""The same of a capsule, in radii before it is twisted."""
NO_NECK = -1


class Walls(NamedTuple):
    """All balloons of a sculpture together, their vertices one after another."""

    quads: Numbers
    """(F, 4) vertices."""
    triangles: Numbers
    """(T, 3), the first halves of all quads, then the second ones."""
    bubble_of_triangle: Numbers
    """(T,), in plan order."""
    bubble_of_vertex: Numbers
    """A bubble that each vertex belongs to, (V,)."""
    names: tuple[str, ...]
    """Of the bubbles."""
    neck: Numbers
    """Joint in whose neck each vertex lies, (V,); `NO_NECK` of others."""


def walls_of(plan: Plan, meshes: Sequence[BalloonMesh]) -> Walls:
    """Return the walls of a plan; one mesh a balloon, in the order of `Plan.strips`."""
    quads, bubbles, necks = [], [], []
    vertices = before = 0
    rings = [(ring, joint) for joint, group in enumerate(joints_of(plan)) for ring in group.rings]
    for strip, mesh in zip(plan.strips.values(), meshes, strict=True):
        quads.append(mesh.quads.astype(np.int64) + vertices)
        bubbles.append(mesh.quad_bubble.astype(np.int64) + before)
        neck = np.full(len(mesh.points), NO_NECK, dtype=np.int64)
        for ring, joint in rings:
            place = plan.table.rings[ring]
            if place.balloon == strip.balloon and not (strip.inverted and place.along <= 0.0):
                near = np.abs(mesh.along - place.along) <= neck_reach(strip)
                # Knot and lip lie behind their ring.
                neck[near | (mesh.along < 0.0) if place.along <= 0.0 else near] = joint
        necks.append(neck)
        vertices += len(mesh.points)
        before += len(strip.bubbles)
    names = tuple(bubble.name for bubble in plan.bubbles)
    return walls_from(np.concatenate(quads), np.concatenate(bubbles), np.concatenate(necks), names)


def walls_from(quads: Numbers, bubble_of_quad: Numbers, neck: Numbers, names: tuple[str, ...]) -> Walls:
    """Return the walls of quads (F, 4) in bubbles (F,), with the necks of all vertices (V,)."""
    of_vertex = np.zeros(len(neck), dtype=np.int64)
    of_vertex[quads] = bubble_of_quad[:, None]
    return Walls(quads, halves(quads), np.tile(bubble_of_quad, 2), of_vertex, names, neck)


def halves(quads: Numbers) -> Numbers:
    """Return the triangles of quads (F, 4), (2 F, 3): the first halves of all, then the second ones."""
    return np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])


def neck_reach(strip: Strip) -> float:
    """Return how far from its joint rubber of a neck lies unstressed, at most, m."""
    return CAPSULE_NECK_REACH * strip.inflated_radius if strip.capsule else NECK_REACH * strip.size.radius
