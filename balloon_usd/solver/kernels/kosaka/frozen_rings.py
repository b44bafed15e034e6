"""Bubbles of the thesis's model: rings drawn to their mean and then frozen (Kosaka 2008, 3.6), and the
rubber's motion.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.kosaka import Faces, Net
from balloon_usd.solver.kernels.arrays.shared import Balloons, Hands, Joints, Mesh, State
from balloon_usd.solver.kernels.kosaka.drift import drift_at, gain_at
from balloon_usd.solver.kernels.physics.joints import LEAD, held, lead_load

COINCIDENT = wp.constant(1.05)
"""Vertices of a ring coincide when none is farther from their mean than this, in neck radii."""


@wp.func
def pinch_force(
    x: wp.vec3, v: wp.vec3, mean: wp.vec3, radius: float, others: wp.vec3, limit: float, dt: float
) -> wp.vec3:
    """Return the force f_p (m/s2) of a hand that draws a vertex towards the mean of its ring, to a radius
    (m), against the other forces (m/s2) on it; limited (Kosaka 2008, 3.1 and 3.6).
    """
    d = mean - x
    far = wp.length(d)
    way = (wp.max(far - radius, 0.0) / wp.max(far, 1.0e-9)) * d
    f = (way / dt - v) / dt - others
    return wp.vec3(f * (limit / wp.max(wp.length(f), limit)))


@wp.kernel
def move_rubber(
    dt: float,
    fraction: float,
    mesh: Mesh,
    balloons: Balloons,
    net: Net,
    ring_middle: wp.array[wp.vec3],
    hands: Hands,
    faces: Faces,
    state: State,
):
    """Move every vertex that is not frozen by symplectic Euler (Kosaka 2008, eqs. 3.22 and 3.23)."""
    i = wp.tid()
    j = mesh.vertex_joint[i]
    law = net.constants[mesh.vertex_balloon[i]]
    f = net.spring_pull[i] + net.air_pull[i] + balloons.gravity[mesh.vertex_balloon[i]]
    drift = faces.drifts[faces.quad_cluster[mesh.corners[i][0] // 4]]
    f += gain_at(drift, state.x[i]) - balloons.drag[mesh.vertex_balloon[i]] * (
        state.v[i] - drift_at(drift, state.x[i])
    )
    if j >= 0:
        if net.frozen[j] == 1:
            state.x_next[i] = state.x[i]
            return
        if hands.radius_to[j] > 0.0:
            radius = hands.radius_from[j] + fraction * (hands.radius_to[j] - hands.radius_from[j])
            f += pinch_force(state.x[i], state.v[i], ring_middle[j], radius, f, law.force_limit, dt)
    velocity = state.v[i] + f * dt
    state.v[i] = velocity
    state.x_next[i] = state.x[i] + velocity * dt


@wp.kernel
def hold_rings(
    dt: float, frame_seconds: float, fraction: float, net: Net, joints: Joints, hands: Hands, state: State
):
    """Freeze rings whose vertices coincide, carry frozen rings with the hand that holds them, lead open ones,
    and write where they are.

    Middles in m, vector areas in m2, velocities in m/s.
    """
    j, lane = wp.tid()
    first = joints.joint_first[j]
    n = joints.joint_around[j]
    place = wp.vec3(0.0)
    velocity = wp.vec3(0.0)
    for k in range(lane, n, wp.block_dim()):
        place += state.x[first + k]
        velocity += state.v[first + k]
    # Collective: every lane of the block takes part, so no branches here.
    c = wp.tile_sum(wp.tile(place, preserve_type=True))[0] / float(n)
    w = wp.tile_sum(wp.tile(velocity, preserve_type=True))[0] / float(n)
    off = float(0.0)
    for k in range(lane, n, wp.block_dim()):
        off = wp.max(off, wp.length(state.x[first + k] - c))
    far = wp.tile_max(wp.tile(off))[0]
    still = net.frozen[j]
    if hands.radius_to[j] > 0.0 and far < COINCIDENT * net.joint_neck[j]:
        still = 1
    # Measured before the shift, which changes no area: no lane reads what another has moved.
    fan = wp.vec3(0.0)
    for k in range(lane, n, wp.block_dim()):
        fan += wp.cross(state.x[first + (k + n - 1) % n] - c, state.x[first + k] - c)
    area = wp.tile_sum(wp.tile(fan, preserve_type=True))[0]
    goal = hands.hand_from[j] + fraction * (hands.hand_to[j] - hands.hand_from[j])
    wanted = (hands.hand_to[j] - hands.hand_from[j]) / frame_seconds
    shift = wp.vec3(0.0)
    kick = wp.vec3(0.0)
    begin = first
    if still == 1:
        begin = first - joints.joint_carried[j]
        if hands.hand[j] != 0:
            shift = goal - c
        kick = shift / dt
    elif held(hands.hand[j]) == 1:
        shift = goal - c
        kick = wanted - w
    elif hands.hand[j] == LEAD:
        load = lead_load(
            goal - c,
            w - wanted,
            hands.hand_stiffness[j],
            joints.joint_mass[j],
            hands.hand_force[j],
            hands.hand_free[j],
        )
        kick = load * (dt / joints.joint_mass[j])
        shift = kick * dt
    for i in range(begin + lane, first + n, wp.block_dim()):
        state.x[i] = state.x[i] + shift
        if still == 1:
            state.v[i] = kick
        else:
            state.v[i] = state.v[i] + kick
    if lane == 0:
        net.frozen[j] = still
        joints.ring_middle[j] = c + shift
        joints.ring_area[j] = 0.5 * area
        joints.ring_velocity[j] = wp.where(still == 1, kick, w + kick)
