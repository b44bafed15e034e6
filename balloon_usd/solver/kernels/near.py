"""Who is near whom: lists of particles and triangles that may meet before the next search."""

import warp as wp

from balloon_usd.solver.kernels.offsets import (
    FLAT,
    WIDER_OUTSIDE,
    least,
    onto_plane,
    plane_distance,
    shares,
    triangle,
)
from balloon_usd.solver.kernels.springs import Constants


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


@wp.kernel
def near_air(
    air_grid: wp.uint64,
    air_balloon: wp.array[int],
    balloon_world: wp.array[int],
    constants: wp.array[Constants],
    air_cluster: wp.array[int],
    margin: float,
    air: wp.array[wp.vec3],
    neighbour_count: wp.array[int],
    neighbours: wp.array2d[int],
    most_near: wp.array[int],
):
    """List the particles of the same cluster within reach of every particle."""
    a = wp.tid()
    here = air[a]
    world = balloon_world[air_balloon[a]]
    reach = constants[air_balloon[a]].re + margin
    room = neighbours.shape[1]
    count = int(0)
    query = wp.hash_grid_query(air_grid, here, reach, world)
    b = int(0)
    while wp.hash_grid_query_next(query, b):
        if b != a and air_cluster[b] == air_cluster[a] and wp.length_sq(air[b] - here) < reach * reach:
            if count < room:
                neighbours[a, count] = b
            count += 1
    wp.atomic_max(most_near, world, count)
    neighbour_count[a] = wp.min(count, room)


@wp.kernel
def near_faces(
    grid: wp.uint64,
    quads: wp.array[wp.vec4i],
    quad_cluster: wp.array[int],
    air_balloon: wp.array[int],
    balloon_world: wp.array[int],
    constants: wp.array[Constants],
    air_cluster: wp.array[int],
    margin: float,
    quad_half: float,
    x: wp.array[wp.vec3],
    face_normal: wp.array[wp.vec3],
    air: wp.array[wp.vec3],
    air_face_count: wp.array[int],
    air_faces: wp.array2d[int],
    face_air_count: wp.array[int],
    face_air: wp.array2d[int],
    most_near: wp.array[int],
):
    """List the triangles of the same cluster whose offset regions every particle may enter, and enter the
    particle in their lists.

    `quad_half`: largest distance (m) of a quad's corner from its middle.
    """
    p = wp.tid()
    here = air[p]
    law = constants[air_balloon[p]]
    world = balloon_world[air_balloon[p]]
    wider = (1.0 + 3.0 * WIDER_OUTSIDE) * quad_half + margin
    deep = wp.max(law.air_offset, law.leak_offset) + margin
    count = int(0)
    query = wp.hash_grid_query(grid, here, wp.sqrt(deep * deep + wider * wider), world)
    q = int(0)
    while wp.hash_grid_query_next(query, q):
        if quad_cluster[q] == air_cluster[p]:
            for half in range(2):
                t = 2 * q + half
                f = triangle(quads, t)
                a = x[f[0]]
                d = plane_distance(here, a, face_normal[t])
                if d > -law.air_offset - margin and d < law.leak_offset + margin:
                    if may_enter(onto_plane(here, a, face_normal[t]), a, x[f[1]], x[f[2]], margin):
                        if count < air_faces.shape[1]:
                            air_faces[p, count] = t
                        count += 1
                        place = wp.atomic_add(face_air_count, t, 1)
                        if place < face_air.shape[1]:
                            face_air[t, place] = p
    wp.atomic_max(most_near, world, count)
    air_face_count[p] = wp.min(count, air_faces.shape[1])


@wp.kernel
def order_air(
    quad_world: wp.array[int],
    face_air_count: wp.array[int],
    face_air: wp.array2d[int],
    most_near: wp.array[int],
):
    """Sort the particles of every triangle, so that sums do not depend on which thread came first."""
    t = wp.tid()
    count = face_air_count[t]
    wp.atomic_max(most_near, quad_world[t // 2], count)
    count = wp.min(count, face_air.shape[1])
    face_air_count[t] = count
    for k in range(1, count):
        here = face_air[t, k]
        j = int(k)
        while j > 0 and face_air[t, wp.max(j - 1, 0)] > here:
            face_air[t, j] = face_air[t, j - 1]
            j -= 1
        face_air[t, j] = here
