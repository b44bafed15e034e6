"""Leaked air: particles beyond every offset region, or in another bubble, and how they are put back. The
thesis has only offset regions (Kosaka 2008, 3.4).
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import Constants
from balloon_usd.solver.kernels.kosaka.offset_regions import UNSEEN, plane_normal, triangle

AFAR = wp.constant(9.0)
"""Squared distance, in the area of a face, from which its solid angle is that of a point's."""
GOLDEN = wp.constant(wp.vec2(0.75487767, 0.56984029))
"""Steps that spread numbers evenly over a square (Roberts 2018)."""


@wp.func
def solid_angle(p: wp.vec3, a: wp.vec3, b: wp.vec3, c: wp.vec3) -> float:
    """Return half the solid angle of a triangle seen from a point (Van Oosterom & Strackee 1983)."""
    u = a - p
    v = b - p
    w = c - p
    lu = wp.length(u)
    lv = wp.length(v)
    lw = wp.length(w)
    below = lu * lv * lw + wp.dot(u, v) * lw + wp.dot(v, w) * lu + wp.dot(w, u) * lv
    return wp.atan2(wp.dot(u, wp.cross(v, w)), below)


@wp.func
def seen_half(p: wp.vec3, a: wp.vec3, b: wp.vec3, c: wp.vec3, d: wp.vec3) -> float:
    """Return half the solid angle of a quad seen from a point."""
    area = 0.5 * wp.cross(c - a, d - b)
    r = 0.25 * (a + b + c + d) - p
    far = wp.length_sq(r)
    if far > AFAR * wp.length(area):
        return 0.5 * wp.dot(area, r) / (far * wp.sqrt(far))
    return solid_angle(p, a, b, c) + solid_angle(p, a, c, d)


@wp.func
def spread_over(number: int, a: wp.vec3, b: wp.vec3, c: wp.vec3):
    """Return a place on a triangle: numbers that follow each other get places far apart."""
    u = float(number) * GOLDEN[0]
    v = float(number) * GOLDEN[1]
    u -= wp.floor(u)
    v -= wp.floor(v)
    if u + v > 1.0:
        u = 1.0 - u
        v = 1.0 - v
    return (1.0 - u - v) * a + u * b + v * c


@wp.kernel
def find_leaked_air(
    quads: wp.array[wp.vec4i],
    quad_cluster: wp.array[int],
    balloon_quads: wp.array[int],
    air_balloon: wp.array[int],
    constants: wp.array[Constants],
    air_cluster: wp.array[int],
    x: wp.array[wp.vec3],
    air: wp.array[wp.vec3],
    air_speed: wp.array[wp.vec3],
    repairs: wp.array[int],
):
    """Bring every particle round which its bubble's wall does not wind back behind the nearest face of its
    own, at rest.

    `balloon_quads`: first quad of every balloon, and their number.
    Flat arguments, as it goes through all quads for every particle: with structs it took 4 to 7 % longer on
    a CPU.
    """
    p, lane = wp.tid()
    balloon = air_balloon[p]
    here = air[p]
    turns = float(0.0)
    nearest = float(UNSEEN)
    face = int(-1)
    for q in range(balloon_quads[balloon] + lane, balloon_quads[balloon + 1], wp.block_dim()):
        if quad_cluster[q] == air_cluster[p]:
            c = quads[q]
            turns += seen_half(here, x[c[0]], x[c[1]], x[c[2]], x[c[3]])
            far = wp.length_sq(0.25 * (x[c[0]] + x[c[1]] + x[c[2]] + x[c[3]]) - here)
            if far < nearest:
                nearest = far
                face = q
    # Collective: every lane of the block takes part, so no branches here.
    wound = wp.tile_sum(wp.tile(turns))[0]
    least_far = wp.tile_min(wp.tile(nearest))[0]
    # Ties go to the lowest lane.
    chosen = wp.tile_min(wp.tile(wp.where(nearest == least_far, lane, wp.block_dim())))[0]
    if lane == chosen and wound < wp.pi and face >= 0:
        f = triangle(quads, 2 * face + (p + repairs[p]) % 2)
        normal = plane_normal(x[f[0]], x[f[1]], x[f[2]])
        behind = constants[balloon].gamma * normal
        air[p] = spread_over(p + repairs[p], x[f[0]], x[f[1]], x[f[2]]) - behind
        air_speed[p] = wp.vec3(0.0)
        repairs[p] = repairs[p] + 1
