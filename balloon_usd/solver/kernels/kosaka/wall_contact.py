"""Rubber on rubber in the thesis's model: a vertex inside a wall is put back onto it (Kosaka 2008, 3.5)."""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import Constants
from balloon_usd.solver.kernels.arrays.shared import Contacts, Mesh, State
from balloon_usd.solver.kernels.kosaka.offset_regions import (
    WIDER,
    least,
    onto_plane,
    plane_distance,
    plane_normal,
    shares,
    triangle,
)


@wp.func
def onto_wall(r: wp.vec3, normal_r: wp.vec3, a: wp.vec3, b: wp.vec3, c: wp.vec3, thickness: float) -> wp.vec3:
    """Return a vertex moved onto a triangle if it lies behind it within the offset region and their normals
    point against each other (Kosaka 2008, eq. 3.14), else where it is.
    """
    normal = plane_normal(a, b, c)
    d = plane_distance(r, a, normal)
    there = r
    if d < 0.0 and d > -thickness and wp.dot(normal_r, normal) < 0.0:
        on = onto_plane(r, a, normal)
        if least(shares(on, a, b, c)) > -WIDER:
            there = on
    return there


@wp.kernel
def part_walls(
    mesh: Mesh, constants: wp.array[Constants], radius_to: wp.array[float], contacts: Contacts, state: State
):
    """Move every vertex that lies inside a wall onto it (Kosaka 2008, eq. 3.15), and take from its velocity
    what would carry it in again; only the vertex's own velocity is changed. Necks stay where hands closed
    them.
    """
    i = wp.tid()
    j = mesh.vertex_joint[i]
    if j >= 0:
        if radius_to[j] > 0.0:
            state.x_next[i] = state.x[i]
            return
    thickness = constants[mesh.vertex_balloon[i]].contact_offset
    p = state.x[i]
    u = state.v[i]
    for k in range(2):
        q = contacts.target[i, k]
        if q >= 0:
            for half in range(2):
                f = triangle(mesh.quads, 2 * q + half)
                a = state.x[f[0]]
                b = state.x[f[1]]
                c = state.x[f[2]]
                there = onto_wall(p, contacts.normal[i], a, b, c, thickness)
                if wp.length_sq(there - p) > 0.0:
                    face = plane_normal(a, b, c)
                    u -= wp.min(wp.dot(u, face), 0.0) * face
                    p = there
    state.x_next[i] = p
    state.v[i] = u
