"""Wall loads: the force with which other walls press on the wall of each bubble."""

import warp as wp

from balloon_usd.solver.kernels.arrays.shared import Balloons, Contacts, Mesh, State
from balloon_usd.solver.kernels.device.array_access import int_at, int_in, put_float, vec3_at, vec4i_at
from balloon_usd.solver.kernels.device.soa import load_soa
from balloon_usd.solver.kernels.device.warp_reduce import warp_sum


@wp.func
def pressing_on(q: int, i: int, mesh: Mesh, balloons: Balloons, x: wp.array[wp.vec3], f: wp.vec3):
    """Return the part of a contact force (N) on a vertex that is normal to the quad that it touches, from
    inside where it lies in the quad's balloon.
    """
    c = vec4i_at(mesh.quads, q)
    normal = wp.normalize(wp.cross(vec3_at(x, c[2]) - vec3_at(x, c[0]), vec3_at(x, c[3]) - vec3_at(x, c[1])))
    around = int_at(balloons.balloon_host, int_at(mesh.vertex_balloon, i))
    pressing = wp.dot(f, normal)
    return wp.max(wp.where(around == int_at(mesh.quad_balloon, q), -pressing, pressing), 0.0)


@wp.func
def load_of_vertex(i: int, shared: int, mesh: Mesh, balloons: Balloons, contacts: Contacts, state: State):
    """Return the force (N) that presses on each of the quads round a vertex, by the walls that it touches."""
    load = float(0.0)
    for k in range(2):
        if int_in(contacts.target, i, k) >= 0:
            load += pressing_on(
                int_in(contacts.target, i, k),
                i,
                mesh,
                balloons,
                state.x,
                load_soa(contacts.contact_force, i, k, shared),
            )
    beside = float(0.0)
    row = int(i)
    while row >= 0:
        slots = vec4i_at(mesh.corners, row)
        for k in range(4):
            if slots[k] >= 0:
                beside += 1.0
        row = -2 - slots[3]
    return load / wp.max(beside, 1.0)


@wp.kernel
def wall_loads(mesh: Mesh, balloons: Balloons, contacts: Contacts, wall_load: wp.array[float], state: State):
    """Write the sum of all normal contact forces (N) on the wall of every segment, in a fixed order; a warp
    of lanes each on a GPU.

    A wall is pressed where its vertices touch another wall, and where vertices of another touch it.
    """
    s, lane = wp.tid()
    total = float(0.0)
    for q in range(int_at(mesh.segment_quad, s) + lane, int_at(mesh.segment_quad_end, s), wp.block_dim()):
        first = int_at(contacts.hit_first, q)
        for k in range(int_at(contacts.hit_count, q)):
            hit = int_at(contacts.hits, first + k)
            total += pressing_on(
                q, hit // 2, mesh, balloons, state.x, load_soa(contacts.contact_force, hit // 2, hit % 2, 0)
            )
        c = vec4i_at(mesh.quads, q)
        for k in range(4):
            total += load_of_vertex(c[k], 0, mesh, balloons, contacts, state)
    total = warp_sum(total)
    if lane == 0:
        put_float(wall_load, s, total)
