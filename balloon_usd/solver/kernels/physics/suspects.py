"""Suspects: sculptures in which something may have gone wrong between two frames."""

import warp as wp

from balloon_usd.solver.kernels.device.array_access import float_at, int_at, put_vec3, vec3_at

LARGEST = wp.constant(3.0e38)
"""Just below the largest float: what exceeds it is infinite."""


@wp.func
def check_vertex(
    i: int,
    stretch: float,
    vertex_balloon: wp.array[int],
    balloon_world: wp.array[int],
    travel_limit: float,
    stretch_limit: wp.array[float],
    x: wp.array[wp.vec3],
    x_checked: wp.array[wp.vec3],
    suspects: wp.array[int],
):
    """Mark the sculpture of a vertex that has moved more than `travel_limit` (m) in any direction since the
    last check, is stretched more than its balloon may be, or is nowhere.
    """
    b = int_at(vertex_balloon, i)
    p = vec3_at(x, i)
    moved = wp.abs(p - vec3_at(x_checked, i))
    put_vec3(x_checked, i, p)
    # Comparisons with NaN are false, so NaN is marked.
    near = moved[0] <= travel_limit and moved[1] <= travel_limit and moved[2] <= travel_limit
    well = near and stretch <= float_at(stretch_limit, b) and stretch >= -LARGEST
    if not well:
        suspects[int_at(balloon_world, b)] = 1
