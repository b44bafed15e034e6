"""The rings of the wall of a bubble in the frames of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan, PlannedBubble
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]


class WallRings(NamedTuple):
    """Where the corners of the rings of a bubble stand among the points of a frame."""

    balloon: int
    """Index of its balloon, in the order of `Plan.strips`."""
    vertices: NDArray[np.int64]
    """Of each ring among those of the balloon, (R, N)."""

    @classmethod
    def of(cls, plan: Plan, meshes: Sequence[BalloonMesh], bubble: PlannedBubble) -> Self:
        """Find those of a bubble; one mesh a balloon, in the order of `Plan.strips`."""
        balloon = list(plan.strips).index(bubble.balloon)
        mesh = meshes[balloon]
        first = mesh.ring_start[mesh.rings_between(bubble.rest_start, bubble.rest_end)]
        return cls(balloon, first[:, None] + np.arange(mesh.around))

    def corners(self, frame: Frame) -> Floats:
        """Return where they are in a frame, (R, N, 3), m."""
        return frame.points[self.balloon][self.vertices].astype(np.float64)
