"""Fingers that press on the wall from outside: the user's external force (Kosaka 2008, eq. 3.22, f_p)."""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import Finger


@wp.kernel
def press_fingers(
    vertex_balloon: wp.array[int],
    mass: wp.array[float],
    fingers: wp.array[Finger],
    finger_share: wp.array[float],
    dt: float,
    fraction: float,
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
):
    """Add to the velocity (m/s) of every vertex what the force of its finger gives it in a substep."""
    i = wp.tid()
    share = finger_share[i]
    if share > 0.0:
        finger = fingers[vertex_balloon[i]]
        load = share * wp.lerp(finger.load_start, finger.load_end, fraction) * (dt / mass[i])
        tip = finger.start + fraction * (finger.end - finger.start)
        behind = wp.max(wp.dot(tip - x[i], finger.along), 0.0)
        v[i] = v[i] + (load + share * finger.stiff * behind / dt) * finger.along
