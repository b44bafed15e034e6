"""Fingers that press on the wall from outside: the user's external force (Kosaka 2008, eq. 3.22, f_p)."""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import Finger
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, put_vec3
from balloon_usd.solver.kernels.device.coherent_load import coherent_vec3


@wp.func
def press_finger(
    i: int,
    vertex_balloon: wp.array[int],
    mass: wp.array[float],
    fingers: wp.array[Finger],
    finger_share: wp.array[float],
    dt: float,
    fraction: float,
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
    shared: int,
):
    """Add to the velocity (m/s) of a vertex under a finger what the finger's force gives it in a substep."""
    share = float_at(finger_share, i)
    if share > 0.0:
        finger = fingers[int_at(vertex_balloon, i)]
        load = share * wp.lerp(finger.load_start, finger.load_end, fraction) * (dt / float_at(mass, i))
        tip = finger.start + fraction * (finger.end - finger.start)
        behind = wp.max(wp.dot(tip - coherent_vec3(x, i, shared), finger.along), 0.0)
        put_vec3(
            v, i, coherent_vec3(v, i, shared) + (load + share * finger.stiff * behind / dt) * finger.along
        )


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
    """Let fingers press on every vertex for a substep."""
    press_finger(wp.tid(), vertex_balloon, mass, fingers, finger_share, dt, fraction, x, v, 0)
