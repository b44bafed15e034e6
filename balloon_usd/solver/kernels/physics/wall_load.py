"""Wall loads: the force with which other walls press on the wall of each bubble."""

import warp as wp

from balloon_usd.solver.kernels.device.array_access import int_at, int_in, put_float, vec3_at, vec4i_at
from balloon_usd.solver.kernels.device.soa import load_soa
from balloon_usd.solver.kernels.device.warp_reduce import warp_sum


@wp.func
def pressing_on(q: int, quads: wp.array[wp.vec4i], x: wp.array[wp.vec3], f: wp.vec3):
    """Return the part of a contact force (N) that is normal to the quad that is touched."""
    c = vec4i_at(quads, q)
    return wp.max(
        wp.dot(
            f,
            wp.normalize(wp.cross(vec3_at(x, c[2]) - vec3_at(x, c[0]), vec3_at(x, c[3]) - vec3_at(x, c[1]))),
        ),
        0.0,
    )


@wp.func
def load_of_vertex(
    i: int,
    quads: wp.array[wp.vec4i],
    corners: wp.array[wp.vec4i],
    target: wp.array2d[int],
    contact_force: wp.array2d[float],
    x: wp.array[wp.vec3],
):
    """Return the force (N) that presses on each of the quads round a vertex, by the walls that it touches."""
    load = float(0.0)
    for k in range(2):
        if int_in(target, i, k) >= 0:
            load += pressing_on(int_in(target, i, k), quads, x, load_soa(contact_force, i, k))
    beside = float(0.0)
    row = int(i)
    while row >= 0:
        slots = vec4i_at(corners, row)
        for k in range(4):
            if slots[k] >= 0:
                beside += 1.0
        row = -2 - slots[3]
    return load / wp.max(beside, 1.0)


@wp.kernel
def wall_loads(
    quads: wp.array[wp.vec4i],
    corners: wp.array[wp.vec4i],
    segment_quad: wp.array[int],
    segment_quad_end: wp.array[int],
    target: wp.array2d[int],
    hit_count: wp.array[int],
    hits: wp.array2d[int],
    contact_force: wp.array2d[float],
    x: wp.array[wp.vec3],
    wall_load: wp.array[float],
):
    """Write the sum of all normal contact forces (N) on the wall of every segment, in a fixed order; a warp
    of lanes each on a GPU.

    A wall is pressed where its vertices touch another wall, and where vertices of another touch it.
    """
    s, lane = wp.tid()
    total = float(0.0)
    for q in range(int_at(segment_quad, s) + lane, int_at(segment_quad_end, s), wp.block_dim()):
        for k in range(int_at(hit_count, q)):
            hit = int_in(hits, q, k)
            total += pressing_on(q, quads, x, load_soa(contact_force, hit // 2, hit % 2))
        c = vec4i_at(quads, q)
        for k in range(4):
            total += load_of_vertex(c[k], quads, corners, target, contact_force, x)
    total = warp_sum(total)
    if lane == 0:
        put_float(wall_load, s, total)
