"""The closed all-quad mesh of a capsule: the stretched cube-sphere of the experiment (Kosaka 2008, 4).

The capsule lies along +x with its start pole at x = 0. Square caps cover both hemispheres from the pole to 45
degrees; rings of equal distance along the meridian cover all the rest. All vertices lie on the surface.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.ringed_faces import (
    Reals,
    cap_points,
    ring_starts,
    ringed_bubbles,
    ringed_quads,
    ringed_texture,
    unit_circle,
)
from balloon_usd.balloon.tube_mesh import BalloonMesh

if TYPE_CHECKING:
    from collections.abc import Sequence

CAP_ANGLE = 0.25 * math.pi
"""Angle from the pole to the border of a cap, radians."""
EXPERIMENT_LENGTH = 0.20
"""Length of the experiment's capsule, m."""
EXPERIMENT_RADIUS = 0.0255
"""Radius of the experiment's capsule, m: a 260 blown up."""
EXPERIMENT_AROUND = 32
EXPERIMENT_ROWS = 46


def capsule_mesh(length: float, radius: float, around: int, bubble_ends: Sequence[float]) -> BalloonMesh:
    """Return the mesh of a capsule of this length from pole to pole and this radius (m).

    `around`: vertices of a ring, a multiple of four. `bubble_ends`: where each bubble ends, m from the start
    pole along the axis, ascending; the last bubble takes what is beyond.

    Raises:
        ValueError: the capsule is shorter than wide, or `around` is no multiple of four above four.
    """
    if not 2.0 * radius <= length < math.inf or radius <= 0.0:
        raise ValueError(f"a capsule of radius {radius:g} m must be at least twice as long, got {length:g} m")
    if around < 8 or around % 4:
        raise ValueError(f"expected a multiple of four of at least 8 vertices around, got {around}")
    rows = capsule_rows(length, radius, around)
    ring_along, ring_radius = _profile(length, radius, rows)
    rings = np.empty((rows + 1, around, 3))
    rings[:, :, 0] = ring_along[:, None]
    rings[:, :, 1:] = ring_radius[:, None, None] * unit_circle(around)
    flat = cap_points(around, float(ring_radius[0]))
    depth = radius - np.sqrt(radius**2 - np.sum(flat**2, axis=1))
    start, end = np.column_stack([depth, flat]), np.column_stack([length - depth, flat])
    points = np.concatenate([start, rings.reshape(-1, 3), end]).astype(np.float32)
    return BalloonMesh(
        points=points,
        quads=ringed_quads(around, rows + 1),
        st=ringed_texture(around, np.linspace(0.0, 1.0, rows + 1)),
        quad_bubble=ringed_bubbles(around, ring_along, bubble_ends),
        along=points[:, 0].copy(),
        around=around,
        ring_start=ring_starts(around, rows + 1),
        ring_along=ring_along,
    )


def capsule_rows(length: float, radius: float, around: int) -> int:
    """Return the number of rows between the caps: their faces are about as square as in the experiment."""
    height = _meridian(EXPERIMENT_LENGTH, EXPERIMENT_RADIUS) / EXPERIMENT_ROWS
    square = height * (radius / EXPERIMENT_RADIUS) * (EXPERIMENT_AROUND / around)
    return max(1, round(_meridian(length, radius) / square))


def _meridian(length: float, radius: float) -> float:
    """Length of the meridian between the borders of the caps, m."""
    return length - 2.0 * radius + 2.0 * (0.5 * math.pi - CAP_ANGLE) * radius


def _profile(length: float, radius: float, rows: int) -> tuple[Reals, Reals]:
    """Distance from the start pole along the axis and radius of every ring, (rows + 1,) m each."""
    straight = length - 2.0 * radius
    arc = (0.5 * math.pi - CAP_ANGLE) * radius
    s = np.linspace(0.0, straight + 2.0 * arc, rows + 1)
    # Angles from the equators of the two hemispheres; 0 on the straight part.
    before = np.maximum(arc - s, 0.0) / radius
    after = np.maximum(s - arc - straight, 0.0) / radius
    along = radius + np.clip(s - arc, 0.0, straight) + radius * (np.sin(after) - np.sin(before))
    return along, radius * np.cos(before + after)
