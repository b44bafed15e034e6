"""Suspects: sculptures in which something may have gone wrong between two frames."""

import warp as wp

from balloon_usd.solver.kernels.device.array_access import float_at, int_at, put_vec3, vec3_at

LARGEST = wp.constant(3.0e38)
"""What is larger is no number."""


@wp.func
def look_at_vertex(
    i: int,
    stretch: float,
    vertex_balloon: wp.array[int],
    balloon_world: wp.array[int],
    most_way: float,
    most_stretch: wp.array[float],
    x: wp.array[wp.vec3],
    x_shown: wp.array[wp.vec3],
    suspects: wp.array[int],
):
    """Mark the sculpture of a vertex that has moved more than `most_way` (m) in any direction since it was
    looked at last, is stretched more than its balloon may be, or is nowhere.
    """
    b = int_at(vertex_balloon, i)
    p = vec3_at(x, i)
    moved = wp.abs(p - vec3_at(x_shown, i))
    put_vec3(x_shown, i, p)
    # What is no number is neither more nor less than anything.
    near = moved[0] <= most_way and moved[1] <= most_way and moved[2] <= most_way
    well = near and stretch <= float_at(most_stretch, b) and stretch >= -LARGEST
    if not well:
        suspects[int_at(balloon_world, b)] = 1
