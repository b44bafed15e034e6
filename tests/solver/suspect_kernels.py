"""The look at all vertices in a kernel of its own."""

import warp as wp

from balloon_usd.solver.kernels.physics.suspects import look_at_vertex


@wp.kernel
def look_at_vertices(
    vertex_balloon: wp.array[int],
    balloon_world: wp.array[int],
    most_way: float,
    most_stretch: wp.array[float],
    x: wp.array[wp.vec3],
    stretch: wp.array[float],
    x_shown: wp.array[wp.vec3],
    suspects: wp.array[int],
):
    """Mark the sculptures in which something may be wrong."""
    i = wp.tid()
    look_at_vertex(i, stretch[i], vertex_balloon, balloon_world, most_way, most_stretch, x, x_shown, suspects)
