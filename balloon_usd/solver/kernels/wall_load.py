"""Wall loads: the force with which other walls press on the wall of each bubble."""

import warp as wp


@wp.func
def pressing_on(q: int, quads: wp.array[wp.vec4i], x: wp.array[wp.vec3], f: wp.vec3):
    """Return the part of a contact force (N) that is normal to the quad that is touched."""
    c = quads[q]
    return wp.max(wp.dot(f, wp.normalize(wp.cross(x[c[2]] - x[c[0]], x[c[3]] - x[c[1]]))), 0.0)


@wp.func
def load_of_vertex(
    i: int,
    quads: wp.array[wp.vec4i],
    corners: wp.array[wp.vec4i],
    target: wp.array2d[int],
    contact_force: wp.array2d[wp.vec3],
    x: wp.array[wp.vec3],
):
    """Return the force (N) that presses on each of the quads round a vertex, by the walls that it touches."""
    load = float(0.0)
    for k in range(2):
        if target[i, k] >= 0:
            load += pressing_on(target[i, k], quads, x, contact_force[i, k])
    beside = float(0.0)
    row = int(i)
    while row >= 0:
        slots = corners[row]
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
    contact_force: wp.array2d[wp.vec3],
    x: wp.array[wp.vec3],
    wall_load: wp.array[float],
):
    """Write the sum of all normal contact forces (N) on the wall of every segment, in a fixed order.

    A wall is pressed where its vertices touch another wall, and where vertices of another touch it.
    """
    s, lane = wp.tid()
    total = float(0.0)
    for q in range(segment_quad[s] + lane, segment_quad_end[s], wp.block_dim()):
        for k in range(hit_count[q]):
            hit = hits[q, k]
            total += pressing_on(q, quads, x, contact_force[hit // 2, hit % 2])
        c = quads[q]
        for k in range(4):
            total += load_of_vertex(c[k], quads, corners, target, contact_force, x)
    sums = wp.tile_sum(wp.tile(total))
    if lane == 0:
        wall_load[s] = sums[0]
