"""Drift: how a bubble moves as a whole. Drag brakes only what moves against it, so hands carry a bubble's
air and wall along by its joints.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.kosaka import Net
from balloon_usd.solver.kernels.arrays.rows import Drift
from balloon_usd.solver.kernels.arrays.shared import Joints, Mesh


@wp.func
def way_along(drift: Drift, x: wp.vec3) -> float:
    """Return how far a place lies on the way from a cluster's start to its end, 0 to 1."""
    axis = drift.end - drift.start
    return wp.clamp(wp.dot(x - drift.start, axis) / wp.max(wp.length_sq(axis), 1.0e-12), 0.0, 1.0)


@wp.func
def drift_at(drift: Drift, x: wp.vec3) -> wp.vec3:
    """Return how a place of a cluster drifts (m/s)."""
    return wp.vec3(wp.lerp(drift.start_speed, drift.end_speed, way_along(drift, x)))


@wp.func
def gain_at(drift: Drift, x: wp.vec3) -> wp.vec3:
    """Return how the drift at a place of a cluster gains speed (m/s2): air and rubber, next to weightless in
    hands, are not left behind.
    """
    return wp.vec3(wp.lerp(drift.start_gain, drift.end_gain, way_along(drift, x)))


PLUG = wp.constant(3.0)
"""Distance from a neck within which air is kept on its side, in neck radii."""


@wp.func
def behind_neck(x: wp.vec3, joint: wp.vec3, inward: wp.vec3, neck: float) -> float:
    """Return how far (m) a place lies beyond a neck that closes its bubble, 0 where it does not."""
    d = x - joint
    beyond = -wp.dot(d, inward)
    if beyond > 0.0 and wp.length_sq(d) < PLUG * PLUG * neck * neck:
        return beyond
    return 0.0


@wp.func
def kept_in(x: wp.vec3, drift: Drift) -> wp.vec3:
    """Return a place of a cluster, mirrored back where it has slipped through one of its necks: a frozen
    ring is closed (Kosaka 2008, 3.6).
    """
    there = x + 2.0 * behind_neck(x, drift.start, drift.start_inward, drift.neck) * drift.start_inward
    return wp.vec3(
        there + 2.0 * behind_neck(there, drift.end, drift.end_inward, drift.neck) * drift.end_inward
    )


@wp.func
def ring_mean(x: wp.array[wp.vec3], first: int, around: int):
    """Return the middle (m) of a ring of vertices."""
    total = wp.vec3(0.0)
    for k in range(around):
        total += x[first + k]
    return total / float(around)


@wp.kernel
def cluster_drift(
    interval: float, mesh: Mesh, net: Net, joints: Joints, drifts: wp.array[Drift], x: wp.array[wp.vec3]
):
    """Write how every cluster drifts: with its frozen joints, or not at all if it has none; and where these
    keep its air in.

    `interval`: time until the next launch, in which it gains what it drifts faster than at the last (s).
    """
    s = wp.tid()
    last = int(s)
    while mesh.end_joint[last] >= 0 and net.frozen[wp.max(mesh.end_joint[last], 0)] == 0:
        last += 1
    first_joint = mesh.start_joint[s]
    last_joint = mesh.end_joint[last]
    drift = Drift()
    drift.joints = wp.vec2i(-1, last_joint)
    if last_joint >= 0:
        drift.end = joints.ring_middle[last_joint]
        drift.end_speed = joints.ring_velocity[last_joint]
        drift.start_speed = drift.end_speed
        n = joints.joint_around[last_joint]
        drift.end_inward = wp.normalize(ring_mean(x, joints.joint_first[last_joint] - n, n) - drift.end)
        drift.neck = net.joint_neck[last_joint]
    if first_joint >= 0:
        if net.frozen[first_joint] == 1:
            drift.joints[0] = first_joint
            drift.start = joints.ring_middle[first_joint]
            drift.start_speed = joints.ring_velocity[first_joint]
            m = joints.joint_around[first_joint]
            drift.start_inward = wp.normalize(
                ring_mean(x, joints.joint_first[first_joint] + m, m) - drift.start
            )
            drift.neck = net.joint_neck[first_joint]
            if last_joint < 0:
                drift.end_speed = drift.start_speed
    before = drifts[s]
    if before.joints[0] == drift.joints[0] and before.joints[1] == drift.joints[1]:
        drift.start_gain = (drift.start_speed - before.start_speed) / interval
        drift.end_gain = (drift.end_speed - before.end_speed) / interval
    drifts[s] = drift


@wp.kernel
def fastest_air(
    air_cluster: wp.array[int],
    drifts: wp.array[Drift],
    air: wp.array[wp.vec3],
    air_speed: wp.array[wp.vec3],
    fastest: wp.array[float],
):
    """Write how fast any air moves against its bubble's drift (m/s)."""
    a = wp.tid()
    wp.atomic_max(fastest, 0, wp.length(air_speed[a] - drift_at(drifts[air_cluster[a]], air[a])))
