"""Joints: rings closed by a twist, the hands on them, welds between them and the friction that keeps a
weld's pose.
"""

import warp as wp

from balloon_usd.solver.kernels.lanes import lanes_meet, lanes_sum3

GRIP_MODE = 1
LEAD_MODE = 2
CLASP_MODE = 3
GRIP = wp.constant(GRIP_MODE)
"""Hand mode: the ring's middle follows the hand exactly."""
LEAD = wp.constant(LEAD_MODE)
"""Hand mode: the hand draws the ring's middle with limited force."""
CLASP = wp.constant(CLASP_MODE)
"""Hand mode: as a grip, and the closed ring does not turn."""


@wp.func
def held(mode: int):
    """Return 1 where a hand holds a ring exactly."""
    if mode == GRIP or mode == CLASP:
        return 1
    return 0


@wp.func
def lead_load(
    away: wp.vec3, speed: wp.vec3, stiffness: float, mass: float, limit: float, free: wp.vec3
) -> wp.vec3:
    """Return the force (N) of a hand that draws a ring to its goal, not along `free`, and at most `limit`."""
    load = stiffness * away - wp.sqrt(stiffness * mass) * speed
    load -= wp.dot(load, free) * free
    size = wp.length(load)
    if size > limit:
        load = load * (limit / size)
    return load


Axes = wp.types.matrix(shape=(3, 2), dtype=float)
"""The two in-plane unit axes of a ring, as columns."""


@wp.func
def regular_ring(
    x: wp.array[wp.vec3],
    corner: wp.array[wp.vec2],
    first: int,
    around: int,
    c: wp.vec3,
    lane: int,
    lanes: int,
):
    """Return the two in-plane axes of the regular polygon nearest to a ring, as columns (polar
    decomposition).
    """
    a = wp.vec3(0.0)
    b = wp.vec3(0.0)
    for k in range(lane, around, lanes):
        d = x[first + k] - c
        at = corner[first + k]
        a += d * at[0]
        b += d * at[1]
    a = wp.normalize(lanes_sum3(a))
    b = wp.normalize(lanes_sum3(b))
    s = wp.normalize(a + b)
    t = wp.normalize(a - b)
    return wp.matrix_from_cols((s + t) * wp.sqrt(0.5), (s - t) * wp.sqrt(0.5))


@wp.func
def close_ring(
    first: int,
    n: int,
    radius: float,
    turns: int,
    dt: float,
    c: wp.vec3,
    speed: wp.vec3,
    axes: Axes,
    lane: int,
    lanes: int,
    corner: wp.array[wp.vec2],
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
):
    """Put the vertices of a ring on a regular polygon of a radius (m) and return its vector area (m2).

    `turns`: 1 where the ring is free to turn: its shape must neither push nor turn it, not even by
    rounding, which over a second adds up.
    """
    normal = wp.cross(axes * wp.vec2(1.0, 0.0), axes * wp.vec2(0.0, 1.0))
    push = wp.vec3(0.0)
    twist = wp.vec3(0.0)
    for k in range(lane, n, lanes):
        arm = axes * (radius * corner[first + k])
        moved = c + arm - x[first + k]
        push += moved
        twist += wp.cross(arm, moved) / dt + wp.cross(moved, v[first + k] - speed)
        v[first + k] = v[first + k] + moved / dt
        x[first + k] = c + arm
    push = lanes_sum3(push) / (float(n) * dt)
    twist = lanes_sum3(twist)
    spin = wp.vec3(0.0)
    if turns == 1:
        # Moments of inertia of a ring: 1/2 about its diameters, 1 about its axis.
        spin = (2.0 * twist - wp.dot(twist, normal) * normal) / (float(n) * radius * radius)
    for k in range(lane, n, lanes):
        v[first + k] = v[first + k] - push - wp.cross(spin, x[first + k] - c)
    # The sine of the angle between two corners.
    sine = corner[first + 1][1]
    return (0.5 * float(n) * sine * radius * radius) * normal


@wp.func
def move_joint(
    j: int,
    lane: int,
    lanes: int,
    joint_first: wp.array[int],
    joint_around: wp.array[int],
    joint_parts: wp.array[int],
    joint_struts: wp.array2d[int],
    joint_mass: wp.array[float],
    corner: wp.array[wp.vec2],
    dt: float,
    frame_seconds: float,
    fraction: float,
    hand: wp.array[int],
    hand_from: wp.array[wp.vec3],
    hand_to: wp.array[wp.vec3],
    hand_free: wp.array[wp.vec3],
    hand_force: wp.array[float],
    hand_stiffness: wp.array[float],
    radius_from: wp.array[float],
    radius_to: wp.array[float],
    strut_force: wp.array[wp.vec3],
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
    ring_middle: wp.array[wp.vec3],
    ring_area: wp.array[wp.vec3],
    ring_axes: wp.array[Axes],
    ring_speed: wp.array[wp.vec3],
    hand_load: wp.array[wp.vec3],
):
    """Hold, lead and close the ring of a joint, and write where it is and what the hand feels.

    Middles in m, vector areas in m2, speeds in m/s, loads in N. Every lane has its own vertices.
    """
    first = joint_first[j]
    n = joint_around[j]
    c = wp.vec3(0.0)
    w = wp.vec3(0.0)
    for k in range(lane, n, lanes):
        c += x[first + k]
        w += v[first + k]
    c = lanes_sum3(c) / float(n)
    w = lanes_sum3(w) / float(n)
    force = wp.vec3(0.0)
    for k in range(lane, joint_struts.shape[1], lanes):
        s = joint_struts[j, k]
        if s > 0:
            force += strut_force[s - 1]
        elif s < 0:
            force -= strut_force[-s - 1]
    force = lanes_sum3(force)
    goal = hand_from[j] + fraction * (hand_to[j] - hand_from[j])
    wanted = (hand_to[j] - hand_from[j]) / frame_seconds
    load = wp.vec3(0.0)
    if hand[j] == LEAD:
        load = lead_load(goal - c, w - wanted, hand_stiffness[j], joint_mass[j], hand_force[j], hand_free[j])
        force += load
    kick = force * (dt / joint_mass[j])
    shift = kick * dt
    if held(hand[j]) == 1:
        load = (wanted - w) * (joint_mass[j] / dt)
        kick = wanted - w
        shift = goal - c
    for k in range(lane, n, lanes):
        x[first + k] = x[first + k] + shift
        v[first + k] = v[first + k] + kick
    c += shift
    # A ring that parts nothing is never closed: hands only need its middle.
    if joint_parts[j] == 1:
        axes = ring_axes[j]
        turns = int(0)
        if hand[j] != CLASP:
            axes = regular_ring(x, corner, first, n, c, lane, lanes)
            turns = 1
            if lane == 0:
                ring_axes[j] = axes
        lanes_meet()
        if radius_to[j] > 0.0:
            radius = radius_from[j] + fraction * (radius_to[j] - radius_from[j])
            turns = int(1)
            if hand[j] == CLASP:
                turns = 0
            area = close_ring(
                first, n, radius, turns, dt, c, w + kick, ring_axes[j], lane, lanes, corner, x, v
            )
            if lane == 0:
                ring_area[j] = area
        else:
            fan = wp.vec3(0.0)
            for k in range(lane, n, lanes):
                fan += wp.cross(x[first + (k + n - 1) % n] - c, x[first + k] - c)
            fan = lanes_sum3(fan)
            if lane == 0:
                ring_area[j] = 0.5 * fan
    if lane == 0:
        ring_middle[j] = c
        ring_speed[j] = w + kick
        hand_load[j] = load


@wp.kernel
def move_joints(
    joint_first: wp.array[int],
    joint_around: wp.array[int],
    joint_parts: wp.array[int],
    joint_struts: wp.array2d[int],
    joint_mass: wp.array[float],
    corner: wp.array[wp.vec2],
    dt: float,
    frame_seconds: float,
    fraction: float,
    hand: wp.array[int],
    hand_from: wp.array[wp.vec3],
    hand_to: wp.array[wp.vec3],
    hand_free: wp.array[wp.vec3],
    hand_force: wp.array[float],
    hand_stiffness: wp.array[float],
    radius_from: wp.array[float],
    radius_to: wp.array[float],
    strut_force: wp.array[wp.vec3],
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
    ring_middle: wp.array[wp.vec3],
    ring_area: wp.array[wp.vec3],
    ring_axes: wp.array[Axes],
    ring_speed: wp.array[wp.vec3],
    hand_load: wp.array[wp.vec3],
):
    """Hold, lead and close the ring of every joint; a warp of lanes each on a GPU."""
    j, lane = wp.tid()
    move_joint(
        j,
        lane,
        wp.block_dim(),
        joint_first,
        joint_around,
        joint_parts,
        joint_struts,
        joint_mass,
        corner,
        dt,
        frame_seconds,
        fraction,
        hand,
        hand_from,
        hand_to,
        hand_free,
        hand_force,
        hand_stiffness,
        radius_from,
        radius_to,
        strut_force,
        x,
        v,
        ring_middle,
        ring_area,
        ring_axes,
        ring_speed,
        hand_load,
    )


@wp.func
def pair_shift(here: wp.vec3, there: wp.vec3, share: float, gap: float, reach: float):
    """Return how one of two necks moves, given its share of the move, so that they lie between gap and
    reach (m).
    """
    d = here - there
    far = wp.max(wp.length(d), 1.0e-9)
    return d * (share * (wp.clamp(far, gap, reach) / far - 1.0))


@wp.func
def weld_joint_to_others(
    j: int,
    lane: int,
    lanes: int,
    joint_weld: wp.array[int],
    weld_joint: wp.array2d[int],
    weld_size: wp.array[int],
    weld_reach: wp.array[float],
    weld_gap: wp.array[float],
    joint_first: wp.array[int],
    joint_around: wp.array[int],
    joint_mass: wp.array[float],
    hand: wp.array[int],
    dt: float,
    ring_middle: wp.array[wp.vec3],
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
    weld_shift: wp.array[wp.vec3],
):
    """Keep the neck of a joint beside the others of its weld, each pair at least its gap (m) and at most its
    reach (m) apart; write how far it moves (m).
    """
    g = joint_weld[j] - 1
    if g >= 0 and held(hand[j]) == 0:
        size = weld_size[g]
        shift = wp.vec3(0.0)
        for m in range(lane, size, lanes):
            other = weld_joint[g, m]
            if other != j:
                share = float(1.0)
                if held(hand[other]) == 0:
                    share = joint_mass[other] / (joint_mass[j] + joint_mass[other])
                shift += pair_shift(ring_middle[j], ring_middle[other], share, weld_gap[g], weld_reach[g])
        shift = lanes_sum3(shift) / wp.max(float(size - 1), 1.0)
        for m in range(lane, joint_around[j], lanes):
            i = joint_first[j] + m
            x[i] = x[i] + shift
            v[i] = v[i] + shift / dt
        if lane == 0:
            weld_shift[j] = shift


@wp.func
def shift_middle(j: int, weld_shift: wp.array[wp.vec3], ring_middle: wp.array[wp.vec3]):
    """Move the middle (m) of a ring as its weld has moved the ring."""
    ring_middle[j] = ring_middle[j] + weld_shift[j]
    weld_shift[j] = wp.vec3(0.0)


@wp.func
def load_strut(
    s: int,
    strut_joint: wp.array[wp.vec2i],
    strut_stiffness: wp.array[float],
    strut_damping: wp.array[float],
    strut_yield: wp.array[float],
    ring_middle: wp.array[wp.vec3],
    ring_speed: wp.array[wp.vec3],
    strut_length: wp.array[float],
    strut_force: wp.array[wp.vec3],
):
    """Write the force (N) on the first end of a strut; beyond its yield force it gives way for good."""
    ends = strut_joint[s]
    pull = wp.vec3(0.0)
    if ends[0] >= 0:
        d = ring_middle[ends[1]] - ring_middle[ends[0]]
        now = wp.length(d)
        along = d / wp.max(now, 1.0e-6)
        tension = strut_stiffness[s] * (now - strut_length[s])
        if tension > strut_yield[s]:
            strut_length[s] = now - strut_yield[s] / strut_stiffness[s]
            tension = strut_yield[s]
        elif tension < -strut_yield[s]:
            strut_length[s] = now + strut_yield[s] / strut_stiffness[s]
            tension = -strut_yield[s]
        tension += strut_damping[s] * wp.dot(ring_speed[ends[1]] - ring_speed[ends[0]], along)
        pull = tension * along
    strut_force[s] = pull
