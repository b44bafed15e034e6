"""Motion: gathered forces, symplectic Euler, and the spin that a hand gives to a part of a balloon."""

import warp as wp

from balloon_usd.solver.kernels.gas import fan_gradient


@wp.struct
class Spin:
    """A rigid turn of the part of a balloon beyond a joint."""

    beyond: float
    """Unstressed distance from the knot beyond which the balloon turns, m."""
    rate: float
    """Angular velocity, rad/s; 0 for none."""
    axis: wp.vec3
    """Unit axis."""
    point: wp.vec3
    """A point of the axis, m."""


@wp.func
def move_vertex(
    i: int,
    corners: wp.array[wp.vec4i],
    vertex_joint: wp.array[int],
    vertex_balloon: wp.array[int],
    joint_first: wp.array[int],
    joint_around: wp.array[int],
    joint_segment: wp.array[wp.vec2i],
    vertex_along: wp.array[float],
    mass: wp.array[float],
    weight: wp.array[float],
    gravity: wp.array[float],
    drag: wp.array[float],
    dt: float,
    spin: wp.array[Spin],
    target: wp.array2d[int],
    contact_force: wp.array2d[wp.vec3],
    corner_force: wp.array2d[wp.vec3],
    pressure: wp.array[float],
    ring_middle: wp.array[wp.vec3],
    ring_area: wp.array[wp.vec3],
    x: wp.array[wp.vec3],
    x_next: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
):
    """Gather the forces on a vertex and move it by symplectic Euler (Kosaka 2008, eqs. 3.22 and 3.23)."""
    f = wp.vec3(0.0)
    slots = corners[i]
    for k in range(4):
        slot = slots[k]
        if slot >= 0:
            f += corner_force[slot // 4, slot % 4]
    for k in range(2):
        if target[i, k] >= 0:
            f += contact_force[i, k]
    p = x[i]
    joint = vertex_joint[i]
    if joint >= 0:
        sides = joint_segment[joint]
        if sides[0] >= 0 and sides[1] >= 0:
            first = joint_first[joint]
            n = joint_around[joint]
            k = i - first
            share = 1.0 / float(n)
            before = x[first + (k + n - 1) % n]
            after = x[first + (k + 1) % n]
            fan = fan_gradient(p - ring_middle[joint], after - before, ring_area[joint], share)
            f += (pressure[sides[0]] - pressure[sides[1]]) * fan
    b = vertex_balloon[i]
    pull = wp.vec3(0.0, 0.0, -gravity[b] * weight[i])
    speed = (v[i] + (f + pull) * (dt / mass[i])) * wp.max(1.0 - drag[b] * dt, 0.0)
    p += speed * dt
    turn = spin[b]
    if turn.rate != 0.0 and vertex_along[i] > turn.beyond:
        r = wp.quat_from_axis_angle(turn.axis, turn.rate * dt)
        p = turn.point + wp.quat_rotate(r, p - turn.point)
        speed = wp.quat_rotate(r, speed)
    x_next[i] = p
    v[i] = speed
