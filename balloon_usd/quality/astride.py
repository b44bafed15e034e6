"""How far a bubble lies between two others, or in the hole of a loop."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np

from balloon_usd.quality.solid_angle import WHOLE, solid_angles

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan

    Floats = NDArray[np.float64]

ASTRIDE = 0.25
"""Share beyond which a bubble is held by others: one that lies on two that touch each other has 0.33, one in
the midst of a hole 0.5, and 0.36 to 0.46 in simulations, and below 0.1 where it has slipped out.
"""
WIDE = 0.5
"""Share of its largest radius from which on a ring of a bubble counts: its caps touch at a common joint."""
TOUCHES = 0.3
"""Largest distance of walls that touch, in the radius of a bubble: rings are no walls, and walls lie apart by
the distance at which they begin to press, 2.8 mm on a 260 in draft.
"""


class Tube(NamedTuple):
    """Where the wide rings of a bubble are."""

    middles: Floats
    """(R, 3), m."""
    radii: Floats
    """(R,), m."""

    def nearest(self, other: Tube) -> tuple[float, Floats]:
        """Return how far its wall is from that of another where they are nearest, in its radius there, and
        the unit way there, (3,).
        """
        between = other.middles[None] - self.middles[:, None]
        far = np.linalg.norm(between, axis=2)
        gaps = far - self.radii[:, None] - other.radii[None]
        at = np.unravel_index(int(np.argmin(gaps)), gaps.shape)
        return float(gaps[at] / self.radii[at[0]]), between[at] / max(float(far[at]), 1e-9)


class WallRings(NamedTuple):
    """The rings of a bubble among the points of a frame."""

    balloon: int
    """Index of its balloon, in the order of `Plan.strips`."""
    first: NDArray[np.int64]
    """First vertex of each ring among those of the balloon, (R,)."""
    around: int
    """Vertices of a ring."""

    @classmethod
    def of(cls, plan: Plan, meshes: Sequence[BalloonMesh], name: str) -> Self:
        """Find those of a bubble; one mesh a balloon, in the order of `Plan.strips`."""
        bubble = next(each for each in plan.bubbles if each.name == name)
        balloon = list(plan.strips).index(bubble.balloon)
        mesh = meshes[balloon]
        rings = range(mesh.ring_at(bubble.rest_start), mesh.ring_at(bubble.rest_end) + 1)
        return cls(balloon, np.array([int(mesh.ring_start[ring]) for ring in rings]), mesh.around)

    def tube(self, points: Sequence[NDArray[np.float32]]) -> Tube:
        """Return where those that are wide are; `points`: of all balloons in a frame."""
        corners = points[self.balloon][self.first[:, None] + np.arange(self.around)].astype(np.float64)
        middles = corners.mean(axis=1)
        radii = np.linalg.norm(corners - middles[:, None], axis=2).mean(axis=1)
        wide = radii >= WIDE * radii.max()
        return Tube(middles[wide], radii[wide])


def share_between(own: Tube, one: Tube, other: Tube) -> float:
    """Return the angle between the ways from a bubble to the nearest walls of two others, in half turns; 0
    where it does not touch both.
    """
    gaps, ways = zip(*(own.nearest(side) for side in (one, other)), strict=True)
    if max(gaps) > TOUCHES:
        return 0.0
    return math.acos(max(-1.0, min(1.0, float(ways[0] @ ways[1])))) / math.pi


def share_in_hole(own: Tube, loop: Tube) -> float:
    """Return the share of the solid angle round the middle of a bubble that a loop fills, 0.5 in its plane;
    0 where they do not touch.
    """
    if own.nearest(loop)[0] > TOUCHES:
        return 0.0
    return abs(float(solid_angles(own.middles.mean(axis=0)[None], loop.middles)[0])) / WHOLE
