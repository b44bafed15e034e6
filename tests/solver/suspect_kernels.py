"""The look at all vertices in a kernel of its own."""

import warp as wp

from balloon_usd.solver.kernels.arrays.shared import Balloons, Checks, Mesh, State
from balloon_usd.solver.kernels.physics.suspects import check_vertex


@wp.kernel
def check_vertices(travel_limit: float, mesh: Mesh, balloons: Balloons, checks: Checks, state: State):
    """Mark the sculptures in which something may be wrong."""
    i = wp.tid()
    check_vertex(i, checks.stretch[i], travel_limit, mesh, balloons, checks, state)
