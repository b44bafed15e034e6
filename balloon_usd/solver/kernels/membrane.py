"""Forces of the rubber wall and of the gas on it, one quad at a time."""

import warp as wp

from balloon_usd.solver.kernels.at import float_at, int_at, mat22_at, put_float, vec3_at, vec4_at, vec4i_at
from balloon_usd.solver.kernels.planes import put, seen_in
from balloon_usd.solver.kernels.rubber import LEAST_ENERGY, Knot, Law, membrane_law, softening_factor
from balloon_usd.solver.kernels.seen import vec3_seen

MIN_STRETCH = wp.constant(0.05)
"""Smallest stretch that enters a rubber law (1): a collapsed quad must not divide by zero."""
SLACK = wp.constant(1.0e-4)
"""Difference of squared stretches below which they count as equal (1)."""
TINY = wp.constant(1.0e-16)
"""Squared length of the side of a collapsed quad (m2)."""


@wp.func
def wall_of_quad(
    q: int,
    quads: wp.array[wp.vec4i],
    quad_law: wp.array[int],
    to_rest: wp.array[wp.mat22],
    hourglass: wp.array[wp.vec4],
    rubber_volume: wp.array[float],
    laws: wp.array[Law],
    curves: wp.array[Knot],
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
    origin: wp.vec3,
    softening_rate: wp.array[float],
    peak_energy: wp.array[float],
    corner_force: wp.array2d[float],
    lift: wp.array2d[float],
):
    """Write the force (N) of the wall on the four corners of a quad and what gas will push on (m2), and
    return the volume (m3) between the quad and an origin.
    """
    c = vec4i_at(quads, q)
    law = laws[int_at(quad_law, q)]
    x0 = vec3_seen(x, c[0])
    x1 = vec3_seen(x, c[1])
    x2 = vec3_seen(x, c[2])
    x3 = vec3_seen(x, c[3])
    hoop = 0.5 * (x1 - x0 + x2 - x3)
    axial = 0.5 * (x3 - x0 + x2 - x1)
    b = mat22_at(to_rest, q)
    f1 = hoop * b[0, 0] + axial * b[1, 0]
    f2 = hoop * b[0, 1] + axial * b[1, 1]
    c11 = wp.dot(f1, f1)
    c22 = wp.dot(f2, f2)
    c12 = wp.dot(f1, f2)

    # Squared principal stretches of the mean deformation. Divisions come first: nothing waits for them then.
    known = float_at(peak_energy, q)
    inverse_known = 1.0 / wp.max(known, LEAST_ENERGY)
    mean = 0.5 * (c11 + c22)
    radius = wp.sqrt(wp.max(0.25 * (c11 - c22) * (c11 - c22) + c12 * c12, 0.0))
    large2 = wp.max(mean + radius, MIN_STRETCH * MIN_STRETCH)
    small2 = wp.max(mean - radius, MIN_STRETCH * MIN_STRETCH)
    apart = large2 - small2
    inverse_apart = 1.0 / wp.max(apart, SLACK)
    stress_large = float(0.0)
    stress_small = float(0.0)
    if large2 > 1.0:
        t = membrane_law(law, curves, large2, small2)
        peak = wp.max(known, t[2])
        put_float(peak_energy, q, known + float_at(softening_rate, int_at(quad_law, q)) * (peak - known))
        soft = softening_factor(law, t[2], peak, inverse_known)
        stress_large = soft * t[0]
        stress_small = soft * t[1]
    isotropic = stress_large
    linear = float(0.0)
    if apart > SLACK:
        linear = (stress_large - stress_small) * inverse_apart
        isotropic = stress_large - linear * large2
    s11 = isotropic + linear * c11
    s22 = isotropic + linear * c22
    s12 = linear * c12

    v0 = vec3_seen(v, c[0])
    v1 = vec3_seen(v, c[1])
    v2 = vec3_seen(v, c[2])
    v3 = vec3_seen(v, c[3])
    hoop_rate = 0.5 * (v1 - v0 + v2 - v3)
    axial_rate = 0.5 * (v3 - v0 + v2 - v1)
    g1 = hoop_rate * b[0, 0] + axial_rate * b[1, 0]
    g2 = hoop_rate * b[0, 1] + axial_rate * b[1, 1]
    viscous = law.viscosity / wp.max(mean, 0.25)
    s11 += viscous * wp.dot(f1, g1)
    s22 += viscous * wp.dot(f2, g2)
    s12 += viscous * 0.5 * (wp.dot(f1, g2) + wp.dot(f2, g1))

    w = float_at(rubber_volume, q)
    p1 = w * (f1 * s11 + f2 * s12)
    p2 = w * (f1 * s12 + f2 * s22)
    pull_hoop = 0.5 * (p1 * b[0, 0] + p2 * b[0, 1])
    pull_axial = 0.5 * (p1 * b[1, 0] + p2 * b[1, 1])

    # Hourglass: the one deformation that the mean gradient does not see. What is damped are its products
    # with hoop, axial and normal, the changes seen from the quad itself: a turning quad feels no torque.
    h = vec4_at(hourglass, q)
    bow = h[0] * x0 + h[1] * x1 + h[2] * x2 + h[3] * x3
    bow_rate = h[0] * v0 + h[1] * v1 + h[2] * v2 + h[3] * v3
    normal = wp.cross(hoop, axial)
    normal_rate = wp.cross(hoop_rate, axial) + wp.cross(hoop, axial_rate)
    hoop2 = wp.length_sq(hoop)
    axial2 = wp.length_sq(axial)
    bent = x0 - x1 + x2 - x3
    bent2 = wp.length_sq(bent) + TINY
    slow = law.hourglass_damping
    slow1 = slow * (wp.dot(bow_rate, hoop) + wp.dot(bow, hoop_rate)) / wp.max(hoop2, bent2)
    slow2 = slow * (wp.dot(bow_rate, axial) + wp.dot(bow, axial_rate)) / wp.max(axial2, bent2)
    most2 = wp.max(wp.length_sq(normal), bent2 * wp.max(hoop2, axial2))
    slow3 = slow * (wp.dot(bow_rate, normal) + wp.dot(bow, normal_rate)) / (most2 + TINY * TINY)
    resist = -(bow + slow1 * hoop + slow2 * axial + slow3 * normal)
    pull_hoop += 0.5 * (slow1 * bow + slow3 * wp.cross(axial, bow))
    pull_axial += 0.5 * (slow2 * bow + slow3 * wp.cross(bow, hoop))

    f0 = pull_hoop + pull_axial + h[0] * resist
    fa = -pull_hoop + pull_axial + h[1] * resist
    fb = -pull_hoop - pull_axial + h[2] * resist
    fc = pull_hoop - pull_axial + h[3] * resist

    put(corner_force, q, 0, f0)
    put(corner_force, q, 1, fa)
    put(corner_force, q, 2, fb)
    put(corner_force, q, 3, fc)

    put(lift, q, 0, 0.25 * normal)
    put(lift, q, 1, wp.cross(hoop, bent) / 24.0)
    put(lift, q, 2, wp.cross(bent, axial) / 24.0)
    return wp.dot(0.25 * (x0 + x1 + x2 + x3) - origin, normal) / 3.0


@wp.func
def lift_of_corner(q: int, corner: int, lift: wp.array2d[float]):
    """Return the exact gradient (m2) of the volume under a bilinear patch by one of its corners."""
    hoop = wp.where(corner == 1 or corner == 2, 1.0, -1.0)
    axial = wp.where(corner >= 2, 1.0, -1.0)
    return seen_in(lift, q, 0) + hoop * seen_in(lift, q, 1) + axial * seen_in(lift, q, 2)


@wp.func
def stretch_of_quad(q: int, quads: wp.array[wp.vec4i], to_rest: wp.array[wp.mat22], x: wp.array[wp.vec3]):
    """Return the largest principal stretch of a quad's mean deformation."""
    c = vec4i_at(quads, q)
    b = mat22_at(to_rest, q)
    hoop = 0.5 * (vec3_at(x, c[1]) - vec3_at(x, c[0]) + vec3_at(x, c[2]) - vec3_at(x, c[3]))
    axial = 0.5 * (vec3_at(x, c[3]) - vec3_at(x, c[0]) + vec3_at(x, c[2]) - vec3_at(x, c[1]))
    f1 = hoop * b[0, 0] + axial * b[1, 0]
    f2 = hoop * b[0, 1] + axial * b[1, 1]
    c11 = wp.dot(f1, f1)
    c22 = wp.dot(f2, f2)
    c12 = wp.dot(f1, f2)
    radius = wp.sqrt(wp.max(0.25 * (c11 - c22) * (c11 - c22) + c12 * c12, 0.0))
    return wp.sqrt(0.5 * (c11 + c22) + radius)


@wp.kernel
def vertex_stretch(
    corners: wp.array[wp.vec4i],
    quads: wp.array[wp.vec4i],
    to_rest: wp.array[wp.mat22],
    x: wp.array[wp.vec3],
    stretch: wp.array[float],
):
    """Write the largest principal stretch of the wall at every vertex, the mean over its quads."""
    i = wp.tid()
    total = float(0.0)
    count = float(0.0)
    row = int(i)
    while row >= 0:
        slots = vec4i_at(corners, row)
        for k in range(4):
            if slots[k] >= 0:
                total += stretch_of_quad(slots[k] // 4, quads, to_rest, x)
                count += 1.0
        row = -2 - slots[3]
    put_float(stretch, i, total / wp.max(count, 1.0))
