"""Drift: how a bubble moves as a whole. Drag brakes only what moves against it, so hands carry a bubble's air and
wall along by its joints.
"""

import warp as wp


FEW = wp.constant(2)
"""Neighbours that a particle inside a bubble has more of, however deep it lies."""


@wp.struct
class Drift:
    """The motion of one cluster: that of its ends, and evenly from one to the other between them."""

    start: wp.vec3
    """m"""
    end: wp.vec3
    """m"""
    start_speed: wp.vec3
    """m/s"""
    end_speed: wp.vec3
    """m/s"""


@wp.func
def drift_at(drift: Drift, x: wp.vec3) -> wp.vec3:
    """Return how a place of a cluster drifts (m/s)."""
    axis = drift.end - drift.start
    along = wp.dot(x - drift.start, axis) / wp.max(wp.length_sq(axis), 1.0e-12)
    return wp.vec3(wp.lerp(drift.start_speed, drift.end_speed, wp.clamp(along, 0.0, 1.0)))


@wp.kernel
def cluster_drift(
    start_joint: wp.array[int],
    end_joint: wp.array[int],
    frozen: wp.array[int],
    ring_middle: wp.array[wp.vec3],
    ring_speed: wp.array[wp.vec3],
    drifts: wp.array[Drift],
):
    """Write how every cluster drifts: with its frozen joints, or not at all if it has none."""
    s = wp.tid()
    last = int(s)
    while end_joint[last] >= 0 and frozen[wp.max(end_joint[last], 0)] == 0:
        last += 1
    first_joint = start_joint[s]
    last_joint = end_joint[last]
    drift = Drift()
    if last_joint >= 0:
        drift.end = ring_middle[last_joint]
        drift.end_speed = ring_speed[last_joint]
        drift.start_speed = drift.end_speed
    if first_joint >= 0:
        if frozen[first_joint] == 1:
            drift.start = ring_middle[first_joint]
            drift.start_speed = ring_speed[first_joint]
            if last_joint < 0:
                drift.end_speed = drift.start_speed
    drifts[s] = drift


@wp.kernel
def find_lonely(
    neighbour_count: wp.array2d[int],
    alone: wp.array[int],
    lonely: wp.array[int],
    lonely_count: wp.array[int],
):
    """Mark and count the particles that are near neither their bubble's wall nor others: they may be lost."""
    a = wp.tid()
    lonely[a] = 0
    if alone[a] == 1:
        near = int(0)
        for lane in range(neighbour_count.shape[1]):
            near += neighbour_count[a, lane]
        if near <= FEW:
            lonely[a] = 1
            wp.atomic_add(lonely_count, 0, 1)
