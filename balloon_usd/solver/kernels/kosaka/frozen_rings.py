"""Bubbles of the thesis's model: rings drawn to their mean and then frozen (Kosaka 2008, 3.6), and the
rubber's motion.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import Constants, Drift
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
    corners: wp.array[wp.vec4i],
    vertex_joint: wp.array[int],
    vertex_balloon: wp.array[int],
    quad_cluster: wp.array[int],
    constants: wp.array[Constants],
    gravity: wp.array[float],
    drag: wp.array[float],
    dt: float,
    fraction: float,
    frozen: wp.array[int],
    radius_from: wp.array[float],
    radius_to: wp.array[float],
    ring_middle: wp.array[wp.vec3],
    drifts: wp.array[Drift],
    spring_pull: wp.array[wp.vec3],
    air_pull: wp.array[wp.vec3],
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
    x_next: wp.array[wp.vec3],
):
    """Move every vertex that is not frozen by symplectic Euler (Kosaka 2008, eqs. 3.22 and 3.23)."""
    i = wp.tid()
    j = vertex_joint[i]
    law = constants[vertex_balloon[i]]
    f = spring_pull[i] + air_pull[i] - wp.vec3(0.0, 0.0, gravity[vertex_balloon[i]])
    drift = drifts[quad_cluster[corners[i][0] // 4]]
    f += gain_at(drift, x[i]) - drag[vertex_balloon[i]] * (v[i] - drift_at(drift, x[i]))
    if j >= 0:
        if frozen[j] == 1:
            x_next[i] = x[i]
            return
        if radius_to[j] > 0.0:
            radius = radius_from[j] + fraction * (radius_to[j] - radius_from[j])
            f += pinch_force(x[i], v[i], ring_middle[j], radius, f, law.force_limit, dt)
    velocity = v[i] + f * dt
    v[i] = velocity
    x_next[i] = x[i] + velocity * dt


@wp.kernel
def hold_rings(
    joint_first: wp.array[int],
    joint_around: wp.array[int],
    joint_carried: wp.array[int],
    joint_mass: wp.array[float],
    joint_neck: wp.array[float],
    dt: float,
    frame_seconds: float,
    fraction: float,
    hand: wp.array[int],
    hand_from: wp.array[wp.vec3],
    hand_to: wp.array[wp.vec3],
    hand_free: wp.array[wp.vec3],
    hand_force: wp.array[float],
    hand_stiffness: wp.array[float],
    radius_to: wp.array[float],
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
    frozen: wp.array[int],
    ring_middle: wp.array[wp.vec3],
    ring_area: wp.array[wp.vec3],
    ring_velocity: wp.array[wp.vec3],
):
    """Freeze rings whose vertices coincide, carry frozen rings with the hand that holds them, lead open ones,
    and write where they are.

    Middles in m, vector areas in m2, velocities in m/s.
    """
    j, lane = wp.tid()
    first = joint_first[j]
    n = joint_around[j]
    place = wp.vec3(0.0)
    velocity = wp.vec3(0.0)
    for k in range(lane, n, wp.block_dim()):
        place += x[first + k]
        velocity += v[first + k]
    # Collective: every lane of the block takes part, so no branches here.
    c = wp.tile_sum(wp.tile(place, preserve_type=True))[0] / float(n)
    w = wp.tile_sum(wp.tile(velocity, preserve_type=True))[0] / float(n)
    off = float(0.0)
    for k in range(lane, n, wp.block_dim()):
        off = wp.max(off, wp.length(x[first + k] - c))
    far = wp.tile_max(wp.tile(off))[0]
    still = frozen[j]
    if radius_to[j] > 0.0 and far < COINCIDENT * joint_neck[j]:
        still = 1
    # Measured before the shift, which changes no area: no lane reads what another has moved.
    fan = wp.vec3(0.0)
    for k in range(lane, n, wp.block_dim()):
        fan += wp.cross(x[first + (k + n - 1) % n] - c, x[first + k] - c)
    area = wp.tile_sum(wp.tile(fan, preserve_type=True))[0]
    goal = hand_from[j] + fraction * (hand_to[j] - hand_from[j])
    wanted = (hand_to[j] - hand_from[j]) / frame_seconds
    shift = wp.vec3(0.0)
    kick = wp.vec3(0.0)
    begin = first
    if still == 1:
        begin = first - joint_carried[j]
        if hand[j] != 0:
            shift = goal - c
        kick = shift / dt
    elif held(hand[j]) == 1:
        shift = goal - c
        kick = wanted - w
    elif hand[j] == LEAD:
        load = lead_load(goal - c, w - wanted, hand_stiffness[j], joint_mass[j], hand_force[j], hand_free[j])
        kick = load * (dt / joint_mass[j])
        shift = kick * dt
    for i in range(begin + lane, first + n, wp.block_dim()):
        x[i] = x[i] + shift
        if still == 1:
            v[i] = kick
        else:
            v[i] = v[i] + kick
    if lane == 0:
        frozen[j] = still
        ring_middle[j] = c + shift
        ring_area[j] = 0.5 * area
        ring_velocity[j] = wp.where(still == 1, kick, w + kick)
