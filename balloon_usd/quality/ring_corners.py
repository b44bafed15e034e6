"""Rings of a plan in the frames of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]


class RingCorners(NamedTuple):
    """Where the corners of a planned ring stand among the points of a frame."""

    balloon: int
    """Index of its balloon, in the order of `Plan.strips`."""
    vertices: slice
    """Its corners among the vertices of the balloon."""

    @classmethod
    def of(cls, plan: Plan, meshes: Sequence[BalloonMesh], ring: int) -> Self:
        """Find those of a ring of the plan; one mesh a balloon, in the order of `Plan.strips`."""
        planned = plan.table.rings[ring]
        balloon = list(plan.strips).index(planned.balloon)
        mesh = meshes[balloon]
        first = int(mesh.ring_start[mesh.ring_at(planned.along)])
        return cls(balloon, slice(first, first + mesh.around))

    def places(self, frame: Frame) -> Floats:
        """Return where they are in a frame, (N, 3), m."""
        return frame.points[self.balloon][self.vertices].astype(np.float64)
