"""Joints: rings closed by a twist, the hands on them, welds between them and the friction that keeps a
weld's pose.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Chambers, Forces, Rubber, Struts
from balloon_usd.solver.kernels.arrays.rows import Axes
from balloon_usd.solver.kernels.arrays.shared import Balloons, Contacts, Hands, Joints, Mesh, State, Welds
from balloon_usd.solver.kernels.device.array_access import (
    float_at,
    int_at,
    int_in,
    put_float,
    put_vec3,
    vec2_at,
    vec2i_at,
    vec3_at,
)
from balloon_usd.solver.kernels.device.barrier import warp_barrier
from balloon_usd.solver.kernels.device.coherent_load import coherent_float, coherent_vec3
from balloon_usd.solver.kernels.device.warp_reduce import block_lanes, warp_ballot, warp_sum3, warp_sum8
from balloon_usd.solver.kernels.physics.gas import fan_gradient
from balloon_usd.solver.kernels.physics.motion import LYING, force_on_vertex, lying, step_of_vertex, sticking

GRIP_MODE = 1
LEAD_MODE = 2
CLASP_MODE = 3
GRIP = wp.constant(GRIP_MODE)
"""Hand mode: the ring's middle follows the hand exactly."""
LEAD = wp.constant(LEAD_MODE)
"""Hand mode: the hand draws the ring's middle with limited force."""
CLASP = wp.constant(CLASP_MODE)
"""Hand mode: as a grip, and the closed ring does not turn."""

MERGING = wp.constant(16.0)
"""Speed at which necks that are far apart as they are joined come together, m/s: walls in between hold hands
up, and at once they would come with 50 m/s (ears of a 646 flew apart).
"""


@wp.func
def held(mode: int):
    """Return 1 where a hand holds a ring exactly."""
    if mode == GRIP or mode == CLASP:
        return 1
    return 0


@wp.func
def lead_load(
    away: wp.vec3, velocity: wp.vec3, stiffness: float, mass: float, limit: float, free: wp.vec3
) -> wp.vec3:
    """Return the force (N) of a hand that draws a ring to its goal, not along `free`, and at most `limit`."""
    load = stiffness * away - wp.sqrt(stiffness * mass) * velocity
    load -= wp.dot(load, free) * free
    size = wp.length(load)
    if size > limit:
        load = load * (limit / size)
    return load


@wp.func
def nearest_axes(a: wp.vec3, b: wp.vec3):
    """Return the in-plane axes of the regular polygon nearest to a ring (polar decomposition), given the sums
    of its vertices times the cosines and sines of the polygon's corners.
    """
    p = wp.normalize(a)
    q = wp.normalize(b)
    s = wp.normalize(p + q)
    t = wp.normalize(p - q)
    return wp.matrix_from_cols((s + t) * wp.sqrt(0.5), (s - t) * wp.sqrt(0.5))


@wp.func
def closing_spin(
    n: int,
    radius: float,
    dt: float,
    axes: Axes,
    a: wp.vec3,
    b: wp.vec3,
    va: wp.vec3,
    vb: wp.vec3,
    own: wp.vec3,
):
    """Return the angular velocity (rad/s) that putting a ring on its polygon would give it: a ring that is
    free to turn must not get it.

    `a`, `b`, `va`, `vb`: sums of places and velocities times the polygon's cosines and sines; `own`: angular
    momentum about its middle, per vertex mass.
    """
    p = axes * wp.vec2(1.0, 0.0)
    q = axes * wp.vec2(0.0, 1.0)
    twist = radius * (wp.cross(p, va - a / dt) + wp.cross(q, vb - b / dt)) - own
    normal = wp.cross(p, q)
    # Moments of inertia of a ring: 1/2 about its diameters, 1 about its axis.
    return (2.0 * twist - wp.dot(twist, normal) * normal) / (float(n) * radius * radius)


@wp.func
def ring_fan(first: int, n: int, c: wp.vec3, lane: int, lanes: int, x: wp.array[wp.vec3], shared: int):
    """Return a lane's share of the vector area (m2) of the fan between a ring's vertices and a point near
    them.
    """
    fan = wp.vec3(0.0)
    for k in range(lane, n, lanes):
        fan += wp.cross(
            coherent_vec3(x, first + (k + n - 1) % n, shared) - c, coherent_vec3(x, first + k, shared) - c
        )
    return 0.5 * fan


@wp.func
def block_of_joint(j: int, first: int, end: int, blocks: int, joint_leader: wp.array[int]) -> int:
    """Return which of a sculpture's blocks moves a joint: the same for all of a weld.

    On the CPU it is the one that has most of the walls beside it: with joints given out in turns walls take a
    third longer. `first`, `end`: the sculpture's joints.
    """
    place = int_at(joint_leader, j) - first
    block = place % blocks
    if block_lanes() == 1:
        block = place * blocks // (end - first)
    return block


@wp.func
def joints_of_block(
    j: int, first: int, end: int, block: int, blocks: int, joint_leader: wp.array[int]
) -> int:
    """Return the mask of the lanes of a warp whose joint `j`, if below `end`, is this block's."""
    mine = int(0)
    if j < end:
        mine = wp.where(block_of_joint(j, first, end, blocks, joint_leader) == block, 1, 0)
    return warp_ballot(mine)


@wp.func
def measure_open_ring(j: int, lane: int, lanes: int, shared: int, joints: Joints, hands: Hands, state: State):
    """Write the vector area (m2) of a ring that parts two chambers and is not being closed."""
    if int_at(joints.joint_parts, j) == 1 and float_at(hands.radius_to, j) == 0.0:
        first = int_at(joints.joint_first, j)
        n = int_at(joints.joint_around, j)
        area = warp_sum3(
            ring_fan(first, n, coherent_vec3(joints.ring_middle, j, shared), lane, lanes, state.x, shared),
            lanes,
        )
        if lane == 0:
            put_vec3(joints.ring_area, j, area)


@wp.func
def pull_on_end(strut: int, pull: wp.vec3):
    """Return the force (N) of a strut on a joint, given that on the strut's first end; 0 is no strut, and the
    second end has its number negative.
    """
    return wp.where(strut == 0, wp.vec3(0.0), wp.where(strut > 0, pull, -pull))


@wp.func
def move_joint(
    j: int,
    idle: bool,
    lane: int,
    lanes: int,
    dt: float,
    frame_seconds: float,
    fraction: float,
    shared: int,
    mesh: Mesh,
    balloons: Balloons,
    rubber: Rubber,
    chambers: Chambers,
    joints: Joints,
    struts: Struts,
    hands: Hands,
    contacts: Contacts,
    forces: Forces,
    state: State,
):
    """Move the ring of a joint by the forces on it, hold, lead and close it, and write where it is and what
    the hand feels.

    Positions in m, vector areas in m2, velocities in m/s, loads in N. Every lane has its own vertices;
    `x_next` keeps them where it has several. `idle`: take part in the shuffles and barriers of the warp,
    write nothing.
    """
    first = int_at(joints.joint_first, j)
    n = int_at(joints.joint_around, j)
    mine = wp.where(idle, 0, n)
    parts = int_at(joints.joint_parts, j)
    mode = int_at(hands.hand, j)
    closed = float(0.0)
    if parts == 1 and float_at(hands.radius_to, j) > 0.0:
        closed = float_at(hands.radius_from, j) + fraction * (
            float_at(hands.radius_to, j) - float_at(hands.radius_from, j)
        )
    start = vec3_at(hands.hand_from, j)
    goal = start + fraction * (vec3_at(hands.hand_to, j) - start)
    wanted = (vec3_at(hands.hand_to, j) - start) / frame_seconds
    # Positions relative to the old middle: sums of small numbers keep their digits.
    old_middle = vec3_at(joints.ring_middle, j)
    area = coherent_vec3(joints.ring_area, j, shared)
    axes = joints.ring_axes[j]
    beside = vec2i_at(joints.joint_beside, j)
    side = beside[0]
    inside = coherent_float(chambers.pressure, side, shared)
    outside = coherent_float(chambers.pressure, beside[1], shared)
    heavy = float_at(joints.joint_mass, j)
    grip = float_at(hands.hand_force, j)
    stiffness = float_at(hands.hand_stiffness, j)
    free = vec3_at(hands.hand_free, j)
    touching = int_at(balloons.touching, int_at(mesh.vertex_balloon, first))
    # Walls alone move a closed ring that lies: they would move it out again from where it is put here.
    stays = closed > 0.0 and touching == LYING and held(mode) == 0
    # The sine of the angle between two corners.
    sine = vec2_at(mesh.ring_cos_sin, first + 1)[1]
    # Prefetch: issued early to hide its latency.
    slots = struts.joint_struts.shape[1]
    strut = wp.where(lane < slots, int_in(struts.joint_struts, j, wp.min(lane, slots - 1)), 0)
    pull = coherent_vec3(struts.strut_force, wp.max(wp.abs(strut) - 1, 0), shared)
    # Position and velocity of a vertex; then sums over the ring: of positions and velocities (c, w), of the
    # same times cosines and sines (a, b, va, vb), and angular momentum (own).
    p = wp.vec3(0.0)
    s = wp.vec3(0.0)
    c = wp.vec3(0.0)
    w = wp.vec3(0.0)
    a = wp.vec3(0.0)
    b = wp.vec3(0.0)
    va = wp.vec3(0.0)
    vb = wp.vec3(0.0)
    own = wp.vec3(0.0)
    for k in range(lane, mine, lanes):
        i = first + k
        f = force_on_vertex(i, side, inside, outside, shared, mesh, contacts, forces)
        if parts == 1:
            chord = vec3_at(state.x, first + (k + 1) % n) - vec3_at(state.x, first + (k + n - 1) % n)
            f += (inside - outside) * fan_gradient(
                vec3_at(state.x, i) - old_middle, chord, area, 1.0 / float(n)
            )
        p, s = step_of_vertex(i, f, dt, shared, mesh, balloons, rubber, hands, state)
        put_vec3(state.x_next, i, p)
        put_vec3(state.v, i, s)
        d = p - old_middle
        at = vec2_at(mesh.ring_cos_sin, i)
        c += d
        w += s
        a += at[0] * d
        b += at[1] * d
        va += at[0] * s
        vb += at[1] * s
        own += wp.cross(d, s)
    force = pull_on_end(strut, pull)
    for k in range(lane + lanes, slots, lanes):
        strut = int_in(struts.joint_struts, j, k)
        pull = coherent_vec3(struts.strut_force, wp.max(wp.abs(strut) - 1, 0), shared)
        force += pull_on_end(strut, pull)
    sums = warp_sum8(force, c, w, a, b, va, vb, own, lanes)
    force = sums[0]
    c = sums[1] / float(n)
    w = sums[2] / float(n)
    away = goal - old_middle - c
    load = wp.vec3(0.0)
    if mode == LEAD:
        load = lead_load(away, w - wanted, stiffness, heavy, grip, free)
        force += load
    kick = force * (dt / heavy)
    shift = kick * dt
    if held(mode) == 1:
        load = (wanted - w) * (heavy / dt)
        kick = wanted - w
        shift = away
    turn = wp.vec3(0.0)
    # A ring that parts nothing is never closed: hands only need its middle.
    if parts == 1:
        if mode != CLASP and not stays:
            axes = nearest_axes(sums[3], sums[4])
            if closed > 0.0:
                own = sums[7] - float(n) * wp.cross(c, w)
                turn = closing_spin(n, closed, dt, axes, sums[3], sums[4], sums[5], sums[6], own)
        if closed > 0.0:
            normal = wp.cross(axes * wp.vec2(1.0, 0.0), axes * wp.vec2(0.0, 1.0))
            area = (0.5 * float(n) * sine * closed * closed) * normal
    warp_barrier()
    for k in range(lane, mine, lanes):
        i = first + k
        if lanes < n:
            p = vec3_at(state.x_next, i)
            s = vec3_at(state.v, i)
        d = p - old_middle
        s += kick
        if closed > 0.0:
            arm = axes * (closed * vec2_at(mesh.ring_cos_sin, i))
            s += (c + arm - d) / dt - wp.cross(turn, arm)
            d = c + arm
        else:
            over = sticking(s, touching)
            s -= over
            d -= over * dt
        if not stays:
            put_vec3(state.x, i, old_middle + (d + shift))
        put_vec3(state.v, i, wp.where(stays, wp.vec3(0.0), s))
    if lane == 0 and not idle:
        if not stays:
            put_vec3(joints.ring_middle, j, old_middle + (c + shift))
        put_vec3(joints.ring_velocity, j, wp.where(stays, wp.vec3(0.0), w + kick))
        put_vec3(hands.hand_load, j, load)
        joints.ring_axes[j] = axes
        put_vec3(joints.ring_area, j, area)


@wp.kernel
def measure_rings(
    joint_first: wp.array[int],
    joint_around: wp.array[int],
    ring_cos_sin: wp.array[wp.vec2],
    x: wp.array[wp.vec3],
    ring_middle: wp.array[wp.vec3],
    ring_area: wp.array[wp.vec3],
    ring_axes: wp.array[Axes],
    ring_velocity: wp.array[wp.vec3],
):
    """Write the middle (m), the vector area (m2) and the in-plane axes of every ring, at rest; a warp of
    lanes each on a GPU.
    """
    j, lane = wp.tid()
    lanes = wp.block_dim()
    first = int_at(joint_first, j)
    n = int_at(joint_around, j)
    c = wp.vec3(0.0)
    for k in range(lane, n, lanes):
        c += coherent_vec3(x, first + k, 0)
    c = warp_sum3(c, lanes) / float(n)
    a = wp.vec3(0.0)
    b = wp.vec3(0.0)
    for k in range(lane, n, lanes):
        a += vec2_at(ring_cos_sin, first + k)[0] * (coherent_vec3(x, first + k, 0) - c)
        b += vec2_at(ring_cos_sin, first + k)[1] * (coherent_vec3(x, first + k, 0) - c)
    axes = nearest_axes(warp_sum3(a, lanes), warp_sum3(b, lanes))
    area = warp_sum3(ring_fan(first, n, c, lane, lanes, x, 0), lanes)
    if lane == 0:
        put_vec3(ring_middle, j, c)
        put_vec3(ring_area, j, area)
        ring_axes[j] = axes
        put_vec3(ring_velocity, j, wp.vec3(0.0))


@wp.func
def pair_shift(
    here: wp.vec3, there: wp.vec3, going: wp.vec3, share: float, gap: float, reach: float, dt: float
):
    """Return how one of two necks moves, given its share of the move, so that they lie between gap and
    reach (m), or come nearer at `MERGING`.

    `going`: velocity of the one as the other sees it, m/s.
    """
    d = here - there
    far = wp.max(wp.length(d), 1.0e-9)
    move = wp.clamp(far, gap, reach) - far
    if move < -MERGING * dt:
        move = -(MERGING + wp.dot(going, d) / far) * dt
    return d * (share * move / far)


@wp.func
def weld_joint_to_others(
    j: int,
    idle: bool,
    lane: int,
    lanes: int,
    dt: float,
    mesh: Mesh,
    balloons: Balloons,
    joints: Joints,
    welds: Welds,
    hands: Hands,
    state: State,
):
    """Keep the neck of a joint beside the others of its weld, each pair at least its gap (m) and at most its
    reach (m) apart, unless it lies; write how far it moves (m). `idle`: take part in the shuffles of the
    warp, write nothing.
    """
    g = int_at(welds.joint_weld, j) - 1
    first = int_at(joints.joint_first, j)
    n = int_at(joints.joint_around, j)
    mine = float_at(joints.joint_mass, j)
    here = vec3_at(joints.ring_middle, j)
    velocity = vec3_at(joints.ring_velocity, j)
    free = g >= 0 and held(int_at(hands.hand, j)) == 0 and not lying(first, mesh, balloons) and not idle
    g = wp.max(g, 0)
    size = wp.where(free, int_at(welds.weld_size, g), 0)
    gap = float_at(welds.weld_gap, g)
    reach = float_at(welds.weld_reach, g)
    shift = wp.vec3(0.0)
    for m in range(lane, size, lanes):
        other = int_in(welds.weld_joint, g, m)
        mass = float_at(joints.joint_mass, other)
        share = wp.where(held(int_at(hands.hand, other)) == 1, 1.0, mass / (mine + mass))
        shift += pair_shift(
            here,
            vec3_at(joints.ring_middle, other),
            velocity - vec3_at(joints.ring_velocity, other),
            wp.where(other == j, 0.0, share),
            gap,
            reach,
            dt,
        )
    shift = warp_sum3(shift, lanes) / wp.max(float(size - 1), 1.0)
    if free:
        for m in range(lane, n, lanes):
            put_vec3(state.x, first + m, vec3_at(state.x, first + m) + shift)
            put_vec3(state.v, first + m, vec3_at(state.v, first + m) + shift / dt)
        if lane == 0:
            put_vec3(welds.weld_shift, j, shift)


@wp.func
def shift_middle(j: int, weld_shift: wp.array[wp.vec3], ring_middle: wp.array[wp.vec3]):
    """Move the middle (m) of a ring as its weld has moved the ring."""
    put_vec3(ring_middle, j, vec3_at(ring_middle, j) + vec3_at(weld_shift, j))
    put_vec3(weld_shift, j, wp.vec3(0.0))


@wp.func
def load_strut(s: int, shared: int, joints: Joints, struts: Struts):
    """Write the force (N) on the first end of a strut; beyond its yield force it gives way for good."""
    ends = vec2i_at(struts.strut_joint, s)
    pull = wp.vec3(0.0)
    if ends[0] >= 0:
        d = coherent_vec3(joints.ring_middle, ends[1], shared) - coherent_vec3(
            joints.ring_middle, ends[0], shared
        )
        now = wp.length(d)
        along = d / wp.max(now, 1.0e-6)
        tension = float_at(struts.strut_stiffness, s) * (now - float_at(struts.strut_length, s))
        if tension > float_at(struts.strut_yield, s):
            put_float(
                struts.strut_length,
                s,
                now - float_at(struts.strut_yield, s) / float_at(struts.strut_stiffness, s),
            )
            tension = float_at(struts.strut_yield, s)
        elif tension < -float_at(struts.strut_yield, s):
            put_float(
                struts.strut_length,
                s,
                now + float_at(struts.strut_yield, s) / float_at(struts.strut_stiffness, s),
            )
            tension = -float_at(struts.strut_yield, s)
        tension += float_at(struts.strut_damping, s) * wp.dot(
            coherent_vec3(joints.ring_velocity, ends[1], shared)
            - coherent_vec3(joints.ring_velocity, ends[0], shared),
            along,
        )
        pull = tension * along
    put_vec3(struts.strut_force, s, pull)
