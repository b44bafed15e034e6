"""Suspects: sculptures in which something may have gone wrong between two frames."""

import warp as wp

from balloon_usd.solver.kernels.arrays.shared import Balloons, Checks, Mesh, State
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, put_vec3, vec3_at

LARGEST = wp.constant(3.0e38)
"""Just below the largest float: what exceeds it is infinite."""


@wp.func
def check_vertex(
    i: int, stretch: float, travel_limit: float, mesh: Mesh, balloons: Balloons, checks: Checks, state: State
):
    """Mark the sculpture of a vertex that has moved more than `travel_limit` (m) in any direction since the
    last check, is stretched more than its balloon may be, or is nowhere.
    """
    b = int_at(mesh.vertex_balloon, i)
    p = vec3_at(state.x, i)
    moved = wp.abs(p - vec3_at(checks.x_checked, i))
    put_vec3(checks.x_checked, i, p)
    # Comparisons with NaN are false, so NaN is marked.
    near = moved[0] <= travel_limit and moved[1] <= travel_limit and moved[2] <= travel_limit
    well = near and stretch <= float_at(checks.stretch_limit, b) and stretch >= -LARGEST
    if not well:
        checks.suspects[int_at(balloons.balloon_world, b)] = 1
