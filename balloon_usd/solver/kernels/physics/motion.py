"""Motion: gathered forces, symplectic Euler, and the spins that hands give to sets of vertices."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Chambers, Forces, Rubber
from balloon_usd.solver.kernels.arrays.shared import Balloons, Contacts, Hands, Mesh, State
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, put_vec3, vec3_at, vec4i_at
from balloon_usd.solver.kernels.device.coherent_load import coherent_float, coherent_vec3
from balloon_usd.solver.kernels.device.soa import load_soa

LYING_MODE = 2
LYING = wp.constant(LYING_MODE)
"""Of a balloon that was put down: its walls touch what they touched, and look for nothing else."""
LYING_SPEED = wp.constant(1.0e-3)
"""Largest speed of its wall, m/s: faster it sticks to what it lies on."""
LEADING_SPEED = 0.024
"""Speed at which walls are led out of others while hands work, m/s: 1 mm a frame at 24 frames/s."""
SLOW = wp.constant(1.0)
"""Largest speed of a wall that would have crossed another while hands work, m/s: then contact finds it before
the next search. With 0.3 m/s necks stay shut that should open, with 4 m/s creases are stretched until they
burst. Once hands loosen their grip nothing is slowed: walls that cannot move stir the rest for ever.
"""


@wp.func
def lying(i: int, mesh: Mesh, balloons: Balloons):
    """Return whether a vertex is of a balloon that was put down."""
    return int_at(balloons.touching, int_at(mesh.vertex_balloon, i)) == LYING


@wp.func
def sticking(velocity: wp.vec3, touching: int):
    """Return what a velocity (m/s) has too much where a wall sticks to what it lies on."""
    over = wp.vec3(0.0)
    speed = wp.length(velocity)
    if touching == LYING and speed > LYING_SPEED:
        over = velocity * (1.0 - LYING_SPEED / speed)
    return over


@wp.func
def force_of_further_quads(
    last: int,
    inside: float,
    corners: wp.array[wp.vec4i],
    corner_force: wp.array2d[float],
    volume_gradient: wp.array2d[float],
    shared: int,
):
    """Return the force (N) of the further quads at a vertex, with the gauge pressure (Pa) behind them.

    `last`: fourth slot of the vertex, which says where `corners` goes on: in row -2 - slot.
    """
    f = wp.vec3(0.0)
    more = -2 - last
    while more >= 0:
        slots = vec4i_at(corners, more)
        for k in range(4):
            if slots[k] >= 0:
                q = slots[k] >> 2
                corner = slots[k] & 3
                f += load_soa(corner_force, q, corner, shared) + inside * load_soa(
                    volume_gradient, q, corner, shared
                )
        more = -2 - slots[3]
    return f


@wp.func
def force_on_vertex(
    i: int,
    side: int,
    inside: float,
    beyond: float,
    shared: int,
    mesh: Mesh,
    contacts: Contacts,
    forces: Forces,
):
    """Return the force (N) of wall, gas and other walls on a vertex.

    `inside`, `beyond`: gauge pressures (Pa) in the segment `side` and in the other that it may border on.
    """
    slots = vec4i_at(mesh.corners, i)
    f = load_soa(contacts.contact_force, i, 0, shared) + load_soa(contacts.contact_force, i, 1, shared)
    # Branch-free: an empty slot loads another quad of the vertex, and is masked.
    any_slot = wp.max(wp.max(slots[0], slots[1]), wp.max(slots[2], slots[3]))
    for k in range(4):
        slot = wp.where(slots[k] >= 0, slots[k], any_slot)
        q = slot >> 2
        corner = slot & 3
        p = wp.where(int_at(mesh.quad_segment, q) == side, inside, beyond)
        g = load_soa(forces.corner_force, q, corner, shared) + p * load_soa(
            forces.volume_gradient, q, corner, shared
        )
        f += wp.where(slots[k] >= 0, g, wp.vec3(0.0))
    return f


@wp.func
def step_of_vertex(
    i: int,
    f: wp.vec3,
    dt: float,
    shared: int,
    mesh: Mesh,
    balloons: Balloons,
    rubber: Rubber,
    hands: Hands,
    state: State,
):
    """Return where a force (N) moves a vertex (m) and its velocity there (m/s), by symplectic Euler
    (Kosaka 2008, eqs. 3.22 and 3.23).
    """
    b = int_at(mesh.vertex_balloon, i)
    spin = int_at(hands.vertex_spin, i)
    pull = float_at(rubber.true_mass, i) * vec3_at(balloons.gravity, b)
    # Drag takes from the velocity only: it must not weaken forces against those that act on whole rings.
    kept = wp.max(1.0 - float_at(balloons.drag, b) * dt, 0.0)
    packed = float_at(balloons.packed_drag, b)
    if packed > 0.0 and int_at(mesh.vertex_neck, i) >= 0:
        kept = wp.max(kept - packed * dt, 0.0)
    velocity = kept * coherent_vec3(state.v, i, shared) + (f + pull) * (dt / float_at(mesh.mass, i))
    slowness = float_at(state.slowness, i)
    if slowness > 0.0:
        velocity += vec3_at(state.reaction, i) * (dt / float_at(mesh.mass, i))
        velocity /= wp.max(slowness * wp.length(velocity), 1.0)
    p = coherent_vec3(state.x, i, shared) + velocity * dt
    if spin > 0:
        turn = hands.spins[spin - 1]
        r = wp.quat_from_axis_angle(turn.axis, turn.rate * dt)
        p = turn.point + wp.quat_rotate(r, p - turn.point) + turn.drift * dt
        if turn.free == 0:
            velocity = wp.quat_rotate(r, velocity)
    return p, velocity


@wp.func
def move_vertex(
    i: int,
    dt: float,
    shared: int,
    mesh: Mesh,
    balloons: Balloons,
    rubber: Rubber,
    chambers: Chambers,
    hands: Hands,
    contacts: Contacts,
    forces: Forces,
    state: State,
):
    """Move a vertex (m) that belongs to no ring by the forces on it, and write its velocity (m/s)."""
    segment = int_at(mesh.vertex_segment, i)
    inside = coherent_float(chambers.pressure, segment, shared)
    f = force_on_vertex(i, segment, inside, inside, shared, mesh, contacts, forces)
    last = vec4i_at(mesh.corners, i)[3]
    if last < -1:
        f += force_of_further_quads(
            last, inside, mesh.corners, forces.corner_force, forces.volume_gradient, shared
        )
    p, velocity = step_of_vertex(i, f, dt, shared, mesh, balloons, rubber, hands, state)
    over = sticking(velocity, int_at(balloons.touching, int_at(mesh.vertex_balloon, i)))
    put_vec3(state.x, i, p - over * dt)
    put_vec3(state.v, i, velocity - over)
