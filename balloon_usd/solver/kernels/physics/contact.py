"""Contact of walls: penalty forces from an offset, and Coulomb friction."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Forces
from balloon_usd.solver.kernels.arrays.rows import Touch
from balloon_usd.solver.kernels.arrays.shared import Balloons, Contacts, Mesh, State
from balloon_usd.solver.kernels.device.array_access import (
    float_at,
    int_at,
    int_in,
    vec2_at,
    vec3_at,
    vec4i_at,
)
from balloon_usd.solver.kernels.device.coherent_load import coherent_vec2, coherent_vec3
from balloon_usd.solver.kernels.device.soa import load_soa, store_soa
from balloon_usd.solver.kernels.physics.meeting import FOLDED, INSIDE, in_wall, opposite, seeker_of
from balloon_usd.solver.kernels.physics.patch import SIDE_SLIP, nearer_on_patch, patch_shares

STICK = wp.constant(0.5)
"""Tangential stiffness of a contact, in normal stiffnesses."""
STABLE = wp.constant(0.25)
"""Largest contact stiffness, in the lightest of the vertex masses per squared time step."""
FIRMER = wp.constant(3.0)
"""The same where the speed of the vertex is limited, in that of others: there nothing builds up (ears of a
260 are squeezed to 25 kPa instead of 122).
"""
FIRM = wp.constant(2.5)
"""Pressure that each of two walls adds at zero distance, in the higher gauge pressure behind them: at rest a
fifth of the offset is used up.
"""
DEEPEST = wp.constant(2.0)
"""Overlap beyond which walls are pressed no harder, in offsets: what has gone through is led out, not flung
(scissors with ears of 3 cm flew apart).
"""
CROWD = wp.constant(0.5)
"""Share of the vertices that touch a quad, above 1, by which that limit is divided: two share one limit."""
NORMAL_DAMPING = wp.constant(0.3)
"""Damping of the approach, as a share of what would stop the vertex in one substep."""

LEAST_SHARE = wp.constant(0.01)
"""Least share of their force with which walls press on each other that are folded up in a neck."""


@wp.func
def pressure_behind(i: int, q: int, mesh: Mesh, segment_pressure: wp.array[float]):
    """Return the higher of the gauge pressures (Pa) behind a vertex and behind a quad."""
    behind = float_at(segment_pressure, int_at(mesh.quad_segment, q))
    bubble = int_at(mesh.vertex_segment, i)
    if bubble >= 0:
        behind = wp.max(behind, float_at(segment_pressure, bubble))
    return behind


@wp.func
def share_of_fold(i: int, q: int, mesh: Mesh, balloons: Balloons, contacts: Contacts, x: wp.array[wp.vec3]):
    """Return how hard a vertex presses on a quad, as a share: the less, the deeper they lie in each other in
    one neck.
    """
    neck = int_at(mesh.vertex_neck, i)
    if neck < 0 or neck != int_at(mesh.quad_neck, q) or int_at(contacts.crossed, i) == 1:
        return 1.0
    face = wp.normalize(vec3_at(contacts.quad_area, q))
    depth = wp.dot(face, vec3_at(contacts.quad_middle, q) - vec3_at(x, i))
    offset = float_at(balloons.contact_offset, int_at(mesh.vertex_balloon, i))
    return wp.clamp(1.0 - depth / (FOLDED * offset), LEAST_SHARE, 1.0)


@wp.func
def limits_of_pair(
    pair: int,
    touch: Touch,
    dt: float,
    mesh: Mesh,
    balloons: Balloons,
    contacts: Contacts,
    segment_pressure: wp.array[float],
    slowness: wp.array[float],
    x: wp.array[wp.vec3],
):
    """Return what stays constant between two searches for a vertex that touches a quad: the quad's vertices,
    the stiffness (N/m), the damping (N s/m), the friction, and the distance at which it is pressed (m), below
    0 where it is the insides that touch.
    """
    i = pair >> 1
    q = int_in(contacts.target, i, pair & 1)
    c = vec4i_at(mesh.quads, q)
    lightest = wp.min(
        float_at(mesh.mass, i),
        wp.min(
            wp.min(float_at(mesh.mass, c[0]), float_at(mesh.mass, c[1])),
            wp.min(float_at(mesh.mass, c[2]), float_at(mesh.mass, c[3])),
        ),
    )
    stable = STABLE * wp.where(float_at(slowness, i) > 0.0, FIRMER, 1.0)
    crowd = wp.max(CROWD * float(int_at(contacts.hit_count, q)), 1.0)
    balloon = int_at(mesh.vertex_balloon, i)
    face = wp.length(vec3_at(contacts.quad_area, q))
    offset = float_at(balloons.contact_offset, balloon) + float_at(balloons.contact_arc, balloon) * face
    side = float(1.0)
    most_pressure = wp.max(touch.pressure, FIRM * pressure_behind(i, q, mesh, segment_pressure))
    seeker = seeker_of(i, touch, mesh, balloons)
    if in_wall(q, seeker, mesh):
        side = -1.0
    elif opposite(q, seeker, mesh):
        offset = INSIDE * float_at(balloons.contact_offset, balloon)
        side = -1.0
    else:
        most_pressure *= share_of_fold(i, q, mesh, balloons, contacts, x)
    stiffness = wp.min(
        most_pressure * float_at(contacts.area, i) / offset, stable * lightest / (dt * dt * crowd)
    )
    damping = NORMAL_DAMPING * lightest / (dt * crowd)
    return c, wp.vec4(stiffness, damping, float_at(balloons.friction, balloon), side * offset)


@wp.func
def press_wall(
    pair: int,
    c: wp.vec4i,
    limits: wp.vec4,
    dt: float,
    shared: int,
    contacts: Contacts,
    state: State,
):
    """Write the contact force (N) on a vertex that touches a quad, and where on the quad.

    A penalty along the quad's normal with damping; across it Coulomb friction by an elastic bristle, whose
    deflection is `contacts.slip` and is cut where the bristle slides.

    `pair`: twice the vertex, and which of its walls; `c`, `limits`: of `limits_of_pair`.
    """
    i = pair >> 1
    k = pair & 1
    p = coherent_vec3(state.x, i, shared)
    x0 = coherent_vec3(state.x, c[0], shared)
    x1 = coherent_vec3(state.x, c[1], shared)
    x2 = coherent_vec3(state.x, c[2], shared)
    x3 = coherent_vec3(state.x, c[3], shared)
    # Prefetch: loaded before the test that may not need them.
    velocity = coherent_vec3(state.v, i, shared)
    v0 = coherent_vec3(state.v, c[0], shared)
    v1 = coherent_vec3(state.v, c[1], shared)
    v2 = coherent_vec3(state.v, c[2], shared)
    v3 = coherent_vec3(state.v, c[3], shared)
    before = contacts.slip[i, k]
    # Warm start: it slides little in a substep, so one iteration is enough.
    place = nearer_on_patch(x0, x1, x2, x3, p, vec2_at(contacts.contact_place, pair))
    s = patch_shares(place)
    gap = p - (s[0] * x0 + s[1] * x1 + s[2] * x2 + s[3] * x3)
    area = 0.5 * wp.cross(x2 - x0, x3 - x1)
    size = wp.length(area)
    face = wp.sign(limits[3]) * area / wp.max(size, 1.0e-12)
    height = wp.dot(gap, face)
    offset = wp.abs(limits[3])
    overlap = offset - height
    f = wp.vec3(0.0)
    deflection = wp.vec3(0.0)
    if overlap > 0.0 and wp.length(gap - height * face) < 2.0 * SIDE_SLIP * wp.sqrt(size):
        stiffness = limits[0]
        going = velocity - (s[0] * v0 + s[1] * v1 + s[2] * v2 + s[3] * v3)
        approach = wp.dot(going, face)
        near = wp.min(overlap / offset, 1.0)
        push = wp.max(stiffness * wp.min(overlap, DEEPEST * offset) - limits[1] * near * approach, 0.0)
        along = going - approach * face
        deflection = before + along * dt
        deflection = deflection - wp.dot(deflection, face) * face
        tangential = STICK * stiffness
        most = limits[2] * push / tangential
        length = wp.length(deflection)
        if length > most:
            deflection = deflection * (most / length)
        f = push * face - tangential * deflection
    contacts.slip[i, k] = deflection
    store_soa(contacts.contact_force, i, k, f)
    contacts.contact_place[pair] = place


@wp.func
def balancing_turn(r0: wp.vec3, r1: wp.vec3, r2: wp.vec3, r3: wp.vec3, couple: wp.vec3):
    """Return the vector whose cross products with a quad's corners balance a couple (N m): that of contacts
    across a gap, where the vertex feels a force at one end and the quad its opposite at the other.
    """
    square = wp.dot(r0, r0) + wp.dot(r1, r1) + wp.dot(r2, r2) + wp.dot(r3, r3)
    spread = wp.outer(r0, r0) + wp.outer(r1, r1) + wp.outer(r2, r2) + wp.outer(r3, r3)
    inertia = square * wp.identity(n=3, dtype=float) - spread
    return wp.inverse(inertia) * couple


@wp.func
def press_quad_back(q: int, shared: int, mesh: Mesh, contacts: Contacts, forces: Forces, state: State):
    """Take from the corners of a quad what the vertices that touch it felt, forces and torques."""
    first = int_at(contacts.hit_first, q)
    count = int_at(contacts.hit_count, q)
    c = vec4i_at(mesh.quads, q)
    x0 = coherent_vec3(state.x, c[0], shared)
    x1 = coherent_vec3(state.x, c[1], shared)
    x2 = coherent_vec3(state.x, c[2], shared)
    x3 = coherent_vec3(state.x, c[3], shared)
    middle = 0.25 * (x0 + x1 + x2 + x3)
    r0 = x0 - middle
    r1 = x1 - middle
    r2 = x2 - middle
    r3 = x3 - middle
    f0 = wp.vec3(0.0)
    f1 = wp.vec3(0.0)
    f2 = wp.vec3(0.0)
    f3 = wp.vec3(0.0)
    couple = wp.vec3(0.0)
    for k in range(count):
        hit = int_at(contacts.hits, first + k)
        f = load_soa(contacts.contact_force, hit // 2, hit % 2, shared)
        share = patch_shares(coherent_vec2(contacts.contact_place, hit, shared))
        f0 += share[0] * f
        f1 += share[1] * f
        f2 += share[2] * f
        f3 += share[3] * f
        touched = middle + share[0] * r0 + share[1] * r1 + share[2] * r2 + share[3] * r3
        couple += wp.cross(coherent_vec3(state.x, hit // 2, shared) - touched, f)
    turn = balancing_turn(r0, r1, r2, r3, couple)
    store_soa(
        forces.corner_force, q, 0, load_soa(forces.corner_force, q, 0, shared) - f0 - wp.cross(turn, r0)
    )
    store_soa(
        forces.corner_force, q, 1, load_soa(forces.corner_force, q, 1, shared) - f1 - wp.cross(turn, r1)
    )
    store_soa(
        forces.corner_force, q, 2, load_soa(forces.corner_force, q, 2, shared) - f2 - wp.cross(turn, r2)
    )
    store_soa(
        forces.corner_force, q, 3, load_soa(forces.corner_force, q, 3, shared) - f3 - wp.cross(turn, r3)
    )
