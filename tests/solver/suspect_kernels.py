"""The look at all vertices in a kernel of its own."""

import warp as wp

from balloon_usd.solver.kernels.physics.suspects import check_vertex


@wp.kernel
def check_vertices(
    vertex_balloon: wp.array[int],
    balloon_world: wp.array[int],
    travel_limit: float,
    stretch_limit: wp.array[float],
    x: wp.array[wp.vec3],
    stretch: wp.array[float],
    x_checked: wp.array[wp.vec3],
    suspects: wp.array[int],
):
    """Mark the sculptures in which something may be wrong."""
    i = wp.tid()
    check_vertex(
        i, stretch[i], vertex_balloon, balloon_world, travel_limit, stretch_limit, x, x_checked, suspects
    )
