"""Offset regions: where air and rubber push each other, and where leaked air is found (Kosaka 2008, 3.3,
3.4).

Every quad is two triangles: triangle 2 q has its corners 0, 1, 2, and 2 q + 1 its corners 0, 2, 3.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.kosaka import Faces, Particles
from balloon_usd.solver.kernels.arrays.rows import Constants
from balloon_usd.solver.kernels.arrays.shared import Mesh

REACHES_OVER = 0.5
WIDER = wp.constant(REACHES_OVER)
"""How far an inner offset region reaches beyond its triangle, in barycentric shares: no gaps where a wall
bends inwards.
"""
WIDER_OUTSIDE = wp.constant(0.5)
"""The same of the outer region, where the walls of a round balloon leave gaps."""
UNSEEN = wp.constant(1.0e6)
"""Distance of a triangle that is not there, m."""
FLAT = wp.constant(1.0e-14)
"""Square of twice the area of a triangle without direction (m4)."""


@wp.func
def triangle(quads: wp.array[wp.vec4i], t: int):
    """Return the three vertices of a triangle."""
    c = quads[t // 2]
    if t % 2 == 0:
        return wp.vec3i(c[0], c[1], c[2])
    return wp.vec3i(c[0], c[2], c[3])


@wp.func
def plane_normal(a: wp.vec3, b: wp.vec3, c: wp.vec3) -> wp.vec3:
    """Return the unit normal of a triangle, outward (Kosaka 2008, eq. 3.6)."""
    return wp.vec3(wp.normalize(wp.cross(b - a, c - a)))


@wp.func
def plane_distance(v: wp.vec3, a: wp.vec3, normal: wp.vec3) -> float:
    """Return how far a point is in front of a plane, negative inside (m) (Kosaka 2008, eq. 3.7)."""
    return wp.dot(v - a, normal)


@wp.func
def onto_plane(v: wp.vec3, a: wp.vec3, normal: wp.vec3):
    """Return the projection of a point onto a plane (Kosaka 2008, eqs. 3.8 and 3.14)."""
    return v - plane_distance(v, a, normal) * normal


@wp.func
def shares(v: wp.vec3, a: wp.vec3, b: wp.vec3, c: wp.vec3) -> wp.vec3:
    """Return u, v, w of a point of a triangle's plane (Kosaka 2008, eq. 3.9)."""
    e1 = b - a
    e2 = c - a
    d = v - a
    normal = wp.cross(e1, e2)
    size = wp.max(wp.dot(normal, normal), FLAT)
    at_b = wp.dot(wp.cross(d, e2), normal) / size
    at_c = wp.dot(wp.cross(e1, d), normal) / size
    return wp.vec3(1.0 - at_b - at_c, at_b, at_c)


@wp.func
def least(s: wp.vec3) -> float:
    """Return the smallest of three shares."""
    return wp.min(s[0], wp.min(s[1], s[2]))


@wp.func
def angle_at(p: wp.vec3, q: wp.vec3, r: wp.vec3) -> float:
    """Return the angle (radians) at p between q and r."""
    d = q - p
    e = r - p
    return wp.atan2(wp.length(wp.cross(d, e)), wp.dot(d, e))


@wp.func
def grade(depth: float, beside: float, grading: float) -> float:
    """Return the share of its push that a particle has at a depth (0 at the wall, 1 at the region's end) and
    with `beside` as its smallest barycentric share; 1 everywhere is the thesis's.

    Graded, it is the share of its neighbours' repulsion that a particle lacks behind a plane wall when all
    are evenly spread (eq. 3.4 integrated): such air is at rest up to the wall. Sideways one triangle's share
    fades into the next one's, so that no push jumps.
    """
    left = wp.max(1.0 - depth, 0.0)
    faded = left * left * left * (1.0 + 3.0 * depth) * wp.clamp(0.5 + 0.5 * beside / WIDER, 0.0, 1.0)
    return 1.0 - grading * (1.0 - faded)


@wp.kernel
def face_surface(
    quads: wp.array[wp.vec4i],
    x: wp.array[wp.vec3],
    face_normal: wp.array[wp.vec3],
    face_angles: wp.array[wp.vec3],
):
    """Write the outward unit normal (Kosaka 2008, eq. 3.6) and the angles (radians) of every triangle."""
    t = wp.tid()
    f = triangle(quads, t)
    a = x[f[0]]
    b = x[f[1]]
    c = x[f[2]]
    face_normal[t] = plane_normal(a, b, c)
    first = angle_at(a, b, c)
    second = angle_at(b, c, a)
    face_angles[t] = wp.vec3(first, second, wp.pi - first - second)


@wp.func
def push_shares(p: wp.vec3, normal: wp.vec3, a: wp.vec3, b: wp.vec3, c: wp.vec3, law: Constants) -> wp.vec4:
    """Return how much a particle pushes on the three vertices of a triangle along its normal, in units of the
    push (Kosaka 2008, eqs. 3.7 to 3.10), and after them all of it.
    """
    push = wp.vec4(0.0)
    d = plane_distance(p, a, normal)
    if d < 0.0 and d > -law.air_offset:
        s = shares(onto_plane(p, a, normal), a, b, c)
        beside = least(s)
        if beside > -WIDER:
            g = grade(-d / law.air_offset, beside, law.grading)
            push = wp.vec4(g * s[0], g * s[1], g * s[2], g)
    return push


@wp.kernel
def press_faces(
    mesh: Mesh, constants: wp.array[Constants], particles: Particles, faces: Faces, x: wp.array[wp.vec3]
):
    """Write how much all air pushes on the three vertices of every triangle along its normal, in units of the
    push (Kosaka 2008, eqs. 3.7 to 3.10), and add up how many particles do.
    """
    q, lane = wp.tid()
    c = mesh.quads[q]
    x0 = x[c[0]]
    x1 = x[c[1]]
    x2 = x[c[2]]
    x3 = x[c[3]]
    law = constants[mesh.quad_balloon[q]]
    first = wp.vec4(0.0)
    second = wp.vec4(0.0)
    begin = lane * (faces.face_air.shape[1] // wp.block_dim())
    for k in range(begin, begin + faces.face_air_count[q, lane]):
        p = faces.face_air[q, k]
        if particles.air_cluster[p] == faces.quad_cluster[q]:
            first += push_shares(particles.air[p], faces.face_normal[2 * q], x0, x1, x2, law)
            second += push_shares(particles.air[p], faces.face_normal[2 * q + 1], x0, x2, x3, law)
    f = wp.tile_sum(wp.tile(first, preserve_type=True))[0]
    s = wp.tile_sum(wp.tile(second, preserve_type=True))[0]
    if lane == 0:
        faces.face_push[2 * q] = wp.vec3(f[0], f[1], f[2])
        faces.face_push[2 * q + 1] = wp.vec3(s[0], s[1], s[2])
        faces.face_hits[2 * q] = faces.face_hits[2 * q] + f[3]
        faces.face_hits[2 * q + 1] = faces.face_hits[2 * q + 1] + s[3]


@wp.func
def vertex_push(
    i: int,
    corners: wp.array[wp.vec4i],
    face_normal: wp.array[wp.vec3],
    face_angles: wp.array[wp.vec3],
    face_push: wp.array[wp.vec3],
) -> wp.vec3:
    """Return the angle-weighted mean R_p of what its triangles push a vertex with (Kosaka 2008, eq. 3.11)."""
    slots = corners[i]
    total = wp.vec3(0.0)
    turn = float(0.0)
    for k in range(4):
        if slots[k] >= 0:
            first = 2 * (slots[k] // 4)
            at = slots[k] % 4
            if at != 3:
                total += face_angles[first][at] * face_push[first][at] * face_normal[first]
                turn += face_angles[first][at]
            if at != 1:
                other = wp.max(at - 1, 0)
                total += face_angles[first + 1][other] * face_push[first + 1][other] * face_normal[first + 1]
                turn += face_angles[first + 1][other]
    return wp.vec3(total / wp.max(turn, FLAT))


@wp.kernel
def press_vertices(
    corners: wp.array[wp.vec4i],
    vertex_balloon: wp.array[int],
    constants: wp.array[Constants],
    face_normal: wp.array[wp.vec3],
    face_angles: wp.array[wp.vec3],
    face_push: wp.array[wp.vec3],
    air_pull: wp.array[wp.vec3],
):
    """Write the push R_p (m/s2) of the air on every vertex (Kosaka 2008, eq. 3.11)."""
    i = wp.tid()
    push = constants[vertex_balloon[i]].push
    air_pull[i] = push * vertex_push(i, corners, face_normal, face_angles, face_push)


@wp.kernel
def press_air(
    quads: wp.array[wp.vec4i],
    constants: wp.array[Constants],
    particles: Particles,
    faces: Faces,
    x: wp.array[wp.vec3],
):
    """Write the push D_a (m/s2) of the rubber on every particle (Kosaka 2008, eqs. 3.12 and 3.17) and bring
    leaked ones back, their velocity reset (eqs. 3.13 and 3.18).

    A particle has leaked when of all triangles in whose regions it is the nearest is in its back.
    """
    p, lane = wp.tid()
    law = constants[particles.air_balloon[p]]
    here = particles.air[p]
    total = wp.vec3(0.0)
    nearest = float(UNSEEN)
    face = int(-1)
    begin = lane * (particles.air_faces.shape[1] // wp.block_dim())
    for k in range(begin, begin + particles.air_face_count[p, lane]):
        t = particles.air_faces[p, k]
        if faces.quad_cluster[t // 2] == particles.air_cluster[p]:
            f = triangle(quads, t)
            normal = faces.face_normal[t]
            a = x[f[0]]
            d = plane_distance(here, a, normal)
            if d > -law.air_offset and d < law.leak_offset:
                beside = least(shares(onto_plane(here, a, normal), a, x[f[1]], x[f[2]]))
                if beside > wp.where(d < 0.0, -WIDER, -WIDER_OUTSIDE):
                    if d < 0.0:
                        total -= (law.beta * grade(-d / law.air_offset, beside, law.grading)) * normal
                    if wp.abs(d) < nearest:
                        nearest = wp.abs(d)
                        face = wp.where(d > 0.0, t, -1)
    # Collective: every lane of the block takes part, so no branches here.
    push = wp.tile_sum(wp.tile(total, preserve_type=True))[0]
    least_far = wp.tile_min(wp.tile(nearest))[0]
    # Ties go to the lowest lane.
    chosen = wp.tile_min(wp.tile(wp.where(nearest == least_far, lane, wp.block_dim())))[0]
    if lane == chosen:
        particles.wall_push[p] = push
        if face >= 0:
            particles.air[p] = here - law.gamma * faces.face_normal[face]
            particles.air_speed[p] = wp.vec3(0.0)
            particles.repairs[p] = particles.repairs[p] + 1


@wp.kernel
def cluster_pressures(substeps: float, mesh: Mesh, faces: Faces, x: wp.array[wp.vec3]):
    """Write the gauge pressure (Pa) of every cluster from what pushed on its wall during a frame.

    `pressure_per_hit`: Pa that one particle per wall area (1/m2) stands for, of every balloon.
    """
    s, lane = wp.tid()
    hits = float(0.0)
    area = float(0.0)
    unit = float(0.0)
    for q in range(lane, mesh.quads.shape[0], wp.block_dim()):
        if faces.quad_cluster[q] == s:
            c = mesh.quads[q]
            hits += faces.face_hits[2 * q] + faces.face_hits[2 * q + 1]
            area += 0.5 * wp.length(wp.cross(x[c[2]] - x[c[0]], x[c[3]] - x[c[1]]))
            unit = wp.max(unit, faces.pressure_per_hit[mesh.quad_balloon[q]])
    all_hits = wp.tile_sum(wp.tile(hits))[0]
    all_area = wp.tile_sum(wp.tile(area))[0]
    pressure = wp.tile_max(wp.tile(unit))[0]
    if lane == 0:
        faces.cluster_pressure[s] = pressure * all_hits / (substeps * wp.max(all_area, FLAT))
