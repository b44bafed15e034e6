"""Neighbour lists: particles and triangles that may touch before the next search, from a hash grid.

A block of threads searches for one particle or quad. Each of its lanes queries one of 3 x 3 x 3 boxes of the
neighbourhood and keeps a list of its own, so that lists do not depend on the order of threads. On the CPU a
block has one lane, which queries all.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.kosaka import Faces, Particles
from balloon_usd.solver.kernels.arrays.rows import Constants
from balloon_usd.solver.kernels.arrays.shared import Mesh
from balloon_usd.solver.kernels.device.warp_reduce import WARP
from balloon_usd.solver.kernels.kosaka.offset_regions import (
    FLAT,
    WIDER_OUTSIDE,
    least,
    onto_plane,
    plane_distance,
    shares,
    triangle,
)

LANES = WARP
"""Lanes of a block on a GPU."""


@wp.func
def boxes_for(lanes: int) -> int:
    """Return into how many boxes along each axis the neighbourhood is cut."""
    if lanes >= 27:
        return 3
    return 1


@wp.func
def box_middle(lane: int, boxes: int, reach: float) -> wp.vec3:
    """Return where the middle of a lane's box lies, from the middle of the neighbourhood (m)."""
    place = wp.vec3(float(lane % boxes), float((lane // boxes) % boxes), float(lane // (boxes * boxes)))
    return (2.0 * reach / float(boxes)) * (place + wp.vec3(0.5)) - wp.vec3(reach)


@wp.func
def box_of(d: wp.vec3, boxes: int, reach: float) -> int:
    """Return the lane in whose box a place lies, given from the middle of the neighbourhood (m)."""
    scale = 0.5 * float(boxes) / reach
    i = wp.clamp(int((d[0] + reach) * scale), 0, boxes - 1)
    j = wp.clamp(int((d[1] + reach) * scale), 0, boxes - 1)
    k = wp.clamp(int((d[2] + reach) * scale), 0, boxes - 1)
    return (k * boxes + j) * boxes + i


@wp.func
def may_enter(on: wp.vec3, a: wp.vec3, b: wp.vec3, c: wp.vec3, margin: float) -> bool:
    """Tell whether a point of a triangle's plane lies within a margin (m) of where its regions reach."""
    middle = (a + b + c) / 3.0
    wide = wp.max(wp.length_sq(a - middle), wp.max(wp.length_sq(b - middle), wp.length_sq(c - middle)))
    reach = (1.0 + 3.0 * WIDER_OUTSIDE) * wp.sqrt(wide) + margin
    # The circle bounds the lists of triangles that have collapsed in a neck.
    near = wp.length_sq(on - middle) < reach * reach
    if near:
        # Distance beyond a side, in shares: the height over it is twice the area over its length.
        size = wp.max(wp.length(wp.cross(b - a, c - a)), wp.sqrt(FLAT))
        slack = wp.vec3(wp.length(c - b), wp.length(a - c), wp.length(b - a)) * (margin / size)
        near = least(shares(on, a, b, c) + slack) > -WIDER_OUTSIDE
    return near


@wp.func
def may_meet(
    p: wp.vec3,
    normal: wp.vec3,
    a: wp.vec3,
    b: wp.vec3,
    c: wp.vec3,
    inside: float,
    outside: float,
    margin: float,
) -> bool:
    """Tell whether a particle may come into a triangle's offset regions of these thicknesses (m) before it
    has moved by a margin (m).
    """
    d = plane_distance(p, a, normal)
    meets = d > -inside - margin and d < outside + margin
    if meets:
        meets = may_enter(onto_plane(p, a, normal), a, b, c, margin)
    return meets


@wp.kernel
def near_air(
    grid: wp.uint64,
    margin: float,
    balloon_world: wp.array[int],
    constants: wp.array[Constants],
    particles: Particles,
):
    """List the particles of the same cluster within reach of every particle."""
    a, lane = wp.tid()
    here = particles.air[a]
    world = balloon_world[particles.air_balloon[a]]
    reach = constants[particles.air_balloon[a]].re + margin
    boxes = boxes_for(wp.block_dim())
    capacity = particles.neighbours.shape[1] // wp.block_dim()
    count = int(0)
    if lane < boxes * boxes * boxes:
        middle = here + box_middle(lane, boxes, reach)
        query = wp.hash_grid_query(grid, middle, reach / float(boxes), world)
        b = int(0)
        while wp.hash_grid_query_next(query, b):
            d = particles.air[b] - here
            if (
                b != a
                and wp.length_sq(d) < reach * reach
                and particles.air_cluster[b] == particles.air_cluster[a]
            ):
                if box_of(d, boxes, reach) == lane:
                    if count < capacity:
                        particles.neighbours[a, lane * capacity + count] = b
                    count += 1
    if count > capacity:
        wp.atomic_max(particles.most_near, world, count * wp.block_dim())
    particles.neighbour_count[a, lane] = wp.min(count, capacity)


@wp.kernel
def near_faces(
    grid: wp.uint64,
    margin: float,
    quad_half: float,
    quads: wp.array[wp.vec4i],
    balloon_world: wp.array[int],
    constants: wp.array[Constants],
    quad_middle: wp.array[wp.vec3],
    particles: Particles,
    faces: Faces,
    x: wp.array[wp.vec3],
):
    """List the triangles of the same cluster whose offset regions every particle may enter.

    `quad_half`: largest distance (m) of a quad's corner from its middle.
    """
    p, lane = wp.tid()
    here = particles.air[p]
    law = constants[particles.air_balloon[p]]
    world = balloon_world[particles.air_balloon[p]]
    wider = (1.0 + 3.0 * WIDER_OUTSIDE) * quad_half + margin
    deep = wp.max(law.air_offset, law.leak_offset) + margin
    reach = wp.sqrt(deep * deep + wider * wider)
    boxes = boxes_for(wp.block_dim())
    capacity = particles.air_faces.shape[1] // wp.block_dim()
    count = int(0)
    if lane < boxes * boxes * boxes:
        middle = here + box_middle(lane, boxes, reach)
        query = wp.hash_grid_query(grid, middle, reach / float(boxes), world)
        q = int(0)
        while wp.hash_grid_query_next(query, q):
            d = quad_middle[q] - here
            if wp.length_sq(d) < reach * reach and faces.quad_cluster[q] == particles.air_cluster[p]:
                if box_of(d, boxes, reach) == lane:
                    for half in range(2):
                        t = 2 * q + half
                        f = triangle(quads, t)
                        if may_meet(
                            here,
                            faces.face_normal[t],
                            x[f[0]],
                            x[f[1]],
                            x[f[2]],
                            law.air_offset,
                            law.leak_offset,
                            margin,
                        ):
                            if count < capacity:
                                particles.air_faces[p, lane * capacity + count] = t
                            count += 1
    if count > capacity:
        wp.atomic_max(particles.most_near, world, count * wp.block_dim())
    particles.air_face_count[p, lane] = wp.min(count, capacity)


@wp.kernel
def near_faces_air(
    grid: wp.uint64,
    margin: float,
    quad_half: float,
    mesh: Mesh,
    constants: wp.array[Constants],
    quad_middle: wp.array[wp.vec3],
    particles: Particles,
    faces: Faces,
    x: wp.array[wp.vec3],
):
    """List the particles of the same cluster that may enter the inner offset regions of every quad's
    triangles.

    `quad_half`: largest distance (m) of a quad's corner from its middle.
    """
    q, lane = wp.tid()
    c = mesh.quads[q]
    law = constants[mesh.quad_balloon[q]]
    wider = (1.0 + 3.0 * WIDER_OUTSIDE) * quad_half + margin
    # Bounding ball of the inner region.
    half = 0.5 * law.air_offset + margin
    normal = wp.normalize(wp.cross(x[c[2]] - x[c[0]], x[c[3]] - x[c[1]]))
    here = quad_middle[q] - (0.5 * law.air_offset) * normal
    reach = wp.sqrt(half * half + wider * wider)
    boxes = boxes_for(wp.block_dim())
    capacity = faces.face_air.shape[1] // wp.block_dim()
    count = int(0)
    if lane < boxes * boxes * boxes:
        middle = here + box_middle(lane, boxes, reach)
        query = wp.hash_grid_query(grid, middle, reach / float(boxes), mesh.quad_world[q])
        p = int(0)
        while wp.hash_grid_query_next(query, p):
            d = particles.air[p] - here
            if wp.length_sq(d) < reach * reach and particles.air_cluster[p] == faces.quad_cluster[q]:
                if box_of(d, boxes, reach) == lane:
                    first = may_meet(
                        particles.air[p],
                        faces.face_normal[2 * q],
                        x[c[0]],
                        x[c[1]],
                        x[c[2]],
                        law.air_offset,
                        0.0,
                        margin,
                    )
                    second = may_meet(
                        particles.air[p],
                        faces.face_normal[2 * q + 1],
                        x[c[0]],
                        x[c[2]],
                        x[c[3]],
                        law.air_offset,
                        0.0,
                        margin,
                    )
                    if first or second:
                        if count < capacity:
                            faces.face_air[q, lane * capacity + count] = p
                        count += 1
    if count > capacity:
        wp.atomic_max(particles.most_near, mesh.quad_world[q], count * wp.block_dim())
    faces.face_air_count[q, lane] = wp.min(count, capacity)
