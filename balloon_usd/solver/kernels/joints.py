"""Joints: rings closed by a twist, the hands on them, welds between them and the friction that keeps a
weld's pose.
"""

import warp as wp

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
def turned(p: wp.vec2, turn: wp.vec2):
    """Return a plane vector turned by the angle whose cosine and sine are given."""
    return wp.vec2(p[0] * turn[0] - p[1] * turn[1], p[0] * turn[1] + p[1] * turn[0])


@wp.func
def regular_ring(x: wp.array[wp.vec3], first: int, around: int, c: wp.vec3):
    """Return the two in-plane axes of the regular polygon nearest to a ring, as columns (polar
    decomposition).
    """
    a = wp.vec3(0.0)
    b = wp.vec3(0.0)
    step = 2.0 * wp.pi / float(around)
    turn = wp.vec2(wp.cos(step), wp.sin(step))
    at = wp.vec2(1.0, 0.0)
    for k in range(around):
        d = x[first + k] - c
        a += d * at[0]
        b += d * at[1]
        at = turned(at, turn)
    a = wp.normalize(a)
    b = wp.normalize(b)
    s = wp.normalize(a + b)
    t = wp.normalize(a - b)
    return wp.matrix_from_cols((s + t) * wp.sqrt(0.5), (s - t) * wp.sqrt(0.5))


@wp.kernel
def move_joints(
    joint_first: wp.array[int],
    joint_around: wp.array[int],
    joint_parts: wp.array[int],
    joint_struts: wp.array2d[int],
    joint_mass: wp.array[float],
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
    """Hold, lead and close the ring of every joint, and write where it is and what the hand feels.

    Middles in m, vector areas in m2, speeds in m/s, loads in N.
    """
    j = wp.tid()
    first = joint_first[j]
    n = joint_around[j]
    c = wp.vec3(0.0)
    w = wp.vec3(0.0)
    for k in range(n):
        c += x[first + k]
        w += v[first + k]
    c = c / float(n)
    w = w / float(n)
    force = wp.vec3(0.0)
    for k in range(joint_struts.shape[1]):
        s = joint_struts[j, k]
        if s > 0:
            force += strut_force[s - 1]
        elif s < 0:
            force -= strut_force[-s - 1]
    goal = hand_from[j] + fraction * (hand_to[j] - hand_from[j])
    load = wp.vec3(0.0)
    if hand[j] == LEAD:
        speed = w - (hand_to[j] - hand_from[j]) / frame_seconds
        load = lead_load(goal - c, speed, hand_stiffness[j], joint_mass[j], hand_force[j], hand_free[j])
        force += load
    kick = force * (dt / joint_mass[j])
    shift = kick * dt
    if hand[j] == GRIP or hand[j] == CLASP:
        wanted = (hand_to[j] - hand_from[j]) / frame_seconds
        load = (wanted - w) * (joint_mass[j] / dt)
        kick = wanted - w
        shift = goal - c
    radius = radius_from[j] + fraction * (radius_to[j] - radius_from[j])
    for k in range(n):
        x[first + k] = x[first + k] + shift
        v[first + k] = v[first + k] + kick
    c += shift
    # A ring that parts nothing is never closed: hands only need its middle.
    if joint_parts[j] == 0:
        ring_middle[j] = c
        ring_speed[j] = w + kick
        hand_load[j] = load
        return
    if hand[j] != CLASP:
        ring_axes[j] = regular_ring(x, first, n, c)
    a = wp.vec3(0.0)
    if radius_to[j] > 0.0:
        axes = ring_axes[j]
        normal = wp.cross(axes * wp.vec2(1.0, 0.0), axes * wp.vec2(0.0, 1.0))
        step = 2.0 * wp.pi / float(n)
        turn = wp.vec2(wp.cos(step), wp.sin(step))
        corner = wp.vec2(radius, 0.0)
        push = wp.vec3(0.0)
        twist = wp.vec3(0.0)
        for k in range(n):
            arm = axes * corner
            corner = turned(corner, turn)
            moved = c + arm - x[first + k]
            push += moved
            twist += wp.cross(arm, moved) / dt + wp.cross(moved, v[first + k] - w - kick)
            v[first + k] = v[first + k] + moved / dt
            x[first + k] = c + arm
        # Its shape must neither push nor turn a free ring, not even by rounding: over a second that adds up.
        push = push / (float(n) * dt)
        spin = wp.vec3(0.0)
        if hand[j] != CLASP:
            # Moments of inertia of a ring: 1/2 about its diameters, 1 about its axis.
            spin = (2.0 * twist - wp.dot(twist, normal) * normal) / (float(n) * radius * radius)
        for k in range(n):
            v[first + k] = v[first + k] - push - wp.cross(spin, x[first + k] - c)
        a = (float(n) * turn[1] * radius * radius) * normal
    else:
        last = x[first + n - 1] - c
        for k in range(n):
            here = x[first + k] - c
            a += wp.cross(last, here)
            last = here
    ring_middle[j] = c
    ring_area[j] = 0.5 * a
    ring_speed[j] = w + kick
    hand_load[j] = load


@wp.func
def pair_shift(here: wp.vec3, there: wp.vec3, share: float, gap: float, reach: float):
    """Return how one of two necks moves, given its share of the move, so that they lie between gap and
    reach (m).
    """
    d = here - there
    far = wp.max(wp.length(d), 1.0e-9)
    return d * (share * (wp.clamp(far, gap, reach) / far - 1.0))


@wp.kernel
def hold_welds(
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
):
    """Keep the necks of every weld side by side: each pair at least its gap (m) and at most its reach (m)
    apart.
    """
    g = wp.tid()
    size = weld_size[g]
    for k in range(size):
        j = weld_joint[g, k]
        if held(hand[j]) == 0:
            shift = wp.vec3(0.0)
            for m in range(size):
                if m != k:
                    other = weld_joint[g, m]
                    share = float(1.0)
                    if held(hand[other]) == 0:
                        share = joint_mass[other] / (joint_mass[j] + joint_mass[other])
                    shift += pair_shift(ring_middle[j], ring_middle[other], share, weld_gap[g], weld_reach[g])
            shift = shift / wp.max(float(size - 1), 1.0)
            for m in range(joint_around[j]):
                i = joint_first[j] + m
                x[i] = x[i] + shift
                v[i] = v[i] + shift / dt


@wp.kernel
def weld_middles(
    weld_joint: wp.array2d[int],
    weld_size: wp.array[int],
    joint_first: wp.array[int],
    joint_around: wp.array[int],
    x: wp.array[wp.vec3],
    ring_middle: wp.array[wp.vec3],
):
    """Write the middles (m) of welded rings again, after they were moved."""
    g, k = wp.tid()
    if k < weld_size[g]:
        j = weld_joint[g, k]
        c = wp.vec3(0.0)
        for m in range(joint_around[j]):
            c += x[joint_first[j] + m]
        ring_middle[j] = c / float(joint_around[j])


@wp.kernel
def load_struts(
    strut_joint: wp.array[wp.vec2i],
    strut_stiffness: wp.array[float],
    strut_damping: wp.array[float],
    strut_yield: wp.array[float],
    ring_middle: wp.array[wp.vec3],
    ring_speed: wp.array[wp.vec3],
    strut_length: wp.array[float],
    strut_force: wp.array[wp.vec3],
):
    """Write the force (N) on the first end of every strut; beyond its yield force it gives way for good."""
    s = wp.tid()
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
