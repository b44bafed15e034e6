"""Drift: how a bubble moves as a whole. Drag brakes only what moves against it, so hands carry a bubble's air and
wall along by its joints.
"""

import warp as wp


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
    air_cluster: wp.array[int],
    frozen: wp.array[int],
    ring_middle: wp.array[wp.vec3],
    ring_speed: wp.array[wp.vec3],
    air_speed: wp.array[wp.vec3],
    drifts: wp.array[Drift],
):
    """Write how every cluster drifts: with its frozen joints, or as its air does on average if it has none."""
    s, lane = wp.tid()
    total = wp.vec3(0.0)
    count = float(0.0)
    for a in range(lane, air_cluster.shape[0], wp.block_dim()):
        if air_cluster[a] == s:
            total += air_speed[a]
            count += 1.0
    speeds = wp.tile_sum(wp.tile(total, preserve_type=True))[0]
    counts = wp.tile_sum(wp.tile(count))[0]
    if lane == 0:
        last = int(s)
        while end_joint[last] >= 0 and frozen[wp.max(end_joint[last], 0)] == 0:
            last += 1
        first_joint = start_joint[s]
        last_joint = end_joint[last]
        drift = Drift()
        mean = speeds / wp.max(counts, 1.0)
        drift.start_speed = mean
        drift.end_speed = mean
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
