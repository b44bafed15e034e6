"""A finger with a round tip, or a palm, and the palm of the other hand: bodies that push a wall of latex."""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import Finger
from balloon_usd.solver.kernels.arrays.shared import Balloons, Hands, Mesh, State
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, put_vec3, vec3_at, vec4i_at
from balloon_usd.solver.kernels.device.coherent_load import coherent_vec3

DEEPEST = wp.constant(5.0e-3)
"""Depth from which on a wall is pushed no faster, m: it is led out of the hand, not flung."""
PALM_RADIUS = wp.constant(0.045)
"""Radius of the palm of the other hand, a disc, m."""
FINGER_DAMPING = wp.constant(0.3)
"""Share of its approach to the hand that a touched vertex loses in a substep."""


@wp.func
def depth_in_hand(p: wp.vec3, finger: Finger, tip: wp.vec3):
    """Return how far (m) a point is inside the finger or the palm, along the normal; 0 and below where it is
    in neither.

    Rubber sticks to skin: what the round tip meets it takes along, and does not push it aside, which would
    drive the vertices of a coarse mesh apart until it slips between them.

    `tip`: foremost point of the finger, m.
    """
    depth = float(0.0)
    ahead = wp.dot(p - tip, finger.along)
    aside = wp.length(p - tip - ahead * finger.along)
    if aside < finger.radius and ahead > -2.0 * finger.radius:
        # Of a sphere, seen along the finger, and pressed the less the steeper it is there.
        rise = wp.sqrt(finger.radius * finger.radius - aside * aside) / finger.radius
        depth = rise * (finger.radius * (rise - 1.0) - ahead)
        if finger.flat == 1:
            depth = -ahead
    normal = finger.along
    beyond = wp.dot(p - finger.palm, finger.along)
    if finger.flat == 1:
        # The other palm comes towards it.
        beyond += wp.dot(tip - finger.start, finger.along)
    if beyond > wp.max(depth, 0.0) and aside < PALM_RADIUS:
        depth = beyond
        normal = -finger.along
    return wp.min(depth, DEEPEST), normal


@wp.func
def push_of_hand(p: wp.vec3, velocity: wp.vec3, finger: Finger, tip: wp.vec3, dt: float):
    """Return the velocity (m/s) that a damped penalty gives a point inside the finger or the palm in a
    substep, the unit normal there, and the velocity (m/s) at which it slides on them.
    """
    depth, normal = depth_in_hand(p, finger, tip)
    # The palm is at rest, but that of two which squeeze.
    palm = -float(finger.flat) * finger.velocity
    going = velocity - wp.where(wp.dot(normal, finger.along) > 0.0, finger.velocity, palm)
    approach = wp.dot(going, normal)
    push = float(0.0)
    if depth > 0.0:
        push = wp.max(finger.stiff * depth / dt - FINGER_DAMPING * approach, 0.0)
    return push, normal, going - approach * normal


@wp.func
def push_of_middles(
    i: int,
    finger: Finger,
    tip: wp.vec3,
    dt: float,
    mesh: Mesh,
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
    shared: int,
):
    """Return the velocity (m/s) that a vertex gets from the middles of the quads round it that are inside the
    hand: a finger does not slip between the vertices of a coarse mesh.
    """
    given = wp.vec3(0.0)
    row = int(i)
    while row >= 0:
        slots = vec4i_at(mesh.corners, row)
        for k in range(4):
            if slots[k] >= 0:
                c = vec4i_at(mesh.quads, slots[k] >> 2)
                place = wp.vec3(0.0)
                velocity = wp.vec3(0.0)
                for corner in range(4):
                    place += 0.25 * coherent_vec3(x, c[corner], shared)
                    velocity += 0.25 * coherent_vec3(v, c[corner], shared)
                push, normal, _ = push_of_hand(place, velocity, finger, tip, dt)
                given += (0.25 * push) * normal
        row = -2 - slots[3]
    return given


@wp.func
def push_of_fingertip(
    i: int,
    dt: float,
    fraction: float,
    shared: int,
    mesh: Mesh,
    balloons: Balloons,
    hands: Hands,
    state: State,
):
    """Return the velocity (m/s) that a finger and the palm of the other hand give a vertex in a substep:
    along their normal by a damped penalty, and across it by Coulomb friction, an elastic bristle whose
    deflection (m) is `hands.finger_slip`.
    """
    b = int_at(mesh.vertex_balloon, i)
    finger = hands.fingers[b]
    given = wp.vec3(0.0)
    if finger.radius > 0.0 and int_at(mesh.vertex_segment, i) == finger.segment:
        tip = finger.start + fraction * (finger.end - finger.start)
        p = coherent_vec3(state.x, i, shared)
        push, normal, across = push_of_hand(p, coherent_vec3(state.v, i, shared), finger, tip, dt)
        deflection = wp.vec3(0.0)
        if push > 0.0:
            deflection = vec3_at(hands.finger_slip, i) + across * dt
            deflection -= wp.dot(deflection, normal) * normal
            most = float_at(balloons.friction, b) * push * dt / finger.stiff
            length = wp.length(deflection)
            if length > most:
                deflection *= most / length
        put_vec3(hands.finger_slip, i, deflection)
        given = push * normal - (finger.stiff / dt) * deflection
        given += push_of_middles(i, finger, tip, dt, mesh, state.x, state.v, shared)
    return given
