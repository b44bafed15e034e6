"""Forces of the rubber wall and of the gas on it, one quad at a time."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Forces, Rubber
from balloon_usd.solver.kernels.arrays.rows import Law
from balloon_usd.solver.kernels.arrays.shared import Balloons, Checks, Mesh, State
from balloon_usd.solver.kernels.device.array_access import (
    float_at,
    int_at,
    mat22_at,
    put_float,
    vec3_at,
    vec4_at,
    vec4i_at,
)
from balloon_usd.solver.kernels.device.coherent_load import coherent_vec3
from balloon_usd.solver.kernels.device.soa import store_soa
from balloon_usd.solver.kernels.physics.rubber import (
    LEAST_ENERGY,
    followed_stretches,
    membrane_law,
    softening_factor,
)
from balloon_usd.solver.kernels.physics.suspects import check_vertex

MIN_STRETCH = wp.constant(0.05)
"""Smallest stretch that enters a rubber law (1): a collapsed quad must not divide by zero."""
SLACK = wp.constant(1.0e-4)
"""Difference of squared stretches below which they count as equal (1)."""
TINY = wp.constant(1.0e-16)
"""Squared length of the side of a collapsed quad (m2)."""


@wp.func
def edges_of_quad(x0: wp.vec3, x1: wp.vec3, x2: wp.vec3, x3: wp.vec3):
    """Return the mean edges (m) of a quad round the tube and along it; of speeds, their rates (m/s)."""
    return 0.5 * (x1 - x0 + x2 - x3), 0.5 * (x3 - x0 + x2 - x1)


@wp.func
def gradient_of_quad(hoop: wp.vec3, axial: wp.vec3, b: wp.mat22):
    """Return the columns of the mean deformation gradient of a quad, given its edges (m)."""
    return hoop * b[0, 0] + axial * b[1, 0], hoop * b[0, 1] + axial * b[1, 1]


@wp.func
def squared_stretches(f1: wp.vec3, f2: wp.vec3):
    """Return the squared principal stretches of a deformation gradient."""
    c11 = wp.dot(f1, f1)
    c22 = wp.dot(f2, f2)
    c12 = wp.dot(f1, f2)
    mean = 0.5 * (c11 + c22)
    radius = wp.sqrt(wp.max(0.25 * (c11 - c22) * (c11 - c22) + c12 * c12, 0.0))
    return mean + radius, mean - radius


@wp.func
def stretches_of_quad(x0: wp.vec3, x1: wp.vec3, x2: wp.vec3, x3: wp.vec3, b: wp.mat22):
    """Return the squared principal stretches of a quad, as large as a rubber law needs them."""
    hoop, axial = edges_of_quad(x0, x1, x2, x3)
    f1, f2 = gradient_of_quad(hoop, axial, b)
    large2, small2 = squared_stretches(f1, f2)
    least = MIN_STRETCH * MIN_STRETCH
    return wp.max(large2, least), wp.max(small2, least)


@wp.func
def resistance_to_bow(
    slow: float,
    h: wp.vec4,
    hoop: wp.vec3,
    axial: wp.vec3,
    hoop_rate: wp.vec3,
    axial_rate: wp.vec3,
    x0: wp.vec3,
    x1: wp.vec3,
    x2: wp.vec3,
    x3: wp.vec3,
    v0: wp.vec3,
    v1: wp.vec3,
    v2: wp.vec3,
    v3: wp.vec3,
):
    """Return the resistance of a quad, with a damping of `slow` (s), to the hourglass, the one deformation
    that the mean gradient does not see, and what damping adds to the pulls (N) of its edges.

    What is damped are its products with hoop, axial and normal, the changes seen from the quad itself: a
    turning quad feels no torque.
    """
    bow = h[0] * x0 + h[1] * x1 + h[2] * x2 + h[3] * x3
    bow_rate = h[0] * v0 + h[1] * v1 + h[2] * v2 + h[3] * v3
    normal = wp.cross(hoop, axial)
    normal_rate = wp.cross(hoop_rate, axial) + wp.cross(hoop, axial_rate)
    hoop2 = wp.length_sq(hoop)
    axial2 = wp.length_sq(axial)
    bent = x0 - x1 + x2 - x3
    bent2 = wp.length_sq(bent) + TINY
    slow1 = slow * (wp.dot(bow_rate, hoop) + wp.dot(bow, hoop_rate)) / wp.max(hoop2, bent2)
    slow2 = slow * (wp.dot(bow_rate, axial) + wp.dot(bow, axial_rate)) / wp.max(axial2, bent2)
    most2 = wp.max(wp.length_sq(normal), bent2 * wp.max(hoop2, axial2))
    slow3 = slow * (wp.dot(bow_rate, normal) + wp.dot(bow, normal_rate)) / (most2 + TINY * TINY)
    return (
        -(bow + slow1 * hoop + slow2 * axial + slow3 * normal),
        0.5 * (slow1 * bow + slow3 * wp.cross(axial, bow)),
        0.5 * (slow2 * bow + slow3 * wp.cross(bow, hoop)),
    )


@wp.func
def forces_of_quad(
    law: Law,
    b: wp.mat22,
    h: wp.vec4,
    volume: float,
    softening: float,
    known: float,
    large2: float,
    small2: float,
    t: wp.vec3,
    x0: wp.vec3,
    x1: wp.vec3,
    x2: wp.vec3,
    x3: wp.vec3,
    v0: wp.vec3,
    v1: wp.vec3,
    v2: wp.vec3,
    v3: wp.vec3,
):
    """Return the force (N) of the wall on the four corners of a quad and its peak energy (J/m3) hereafter.

    `b`: inverse rest edges, 1/m; `h`: hourglass vector; `volume`: of its rubber, m3; `softening`: share of a
    rise of the peak energy that counts in this substep; `known`: peak energy so far; `large2`, `small2`:
    squared stretches; `t`: the law's stresses and energy at these. Branch-free, so that CPU compilers
    vectorise it.
    """
    hoop, axial = edges_of_quad(x0, x1, x2, x3)
    f1, f2 = gradient_of_quad(hoop, axial, b)
    c11 = wp.dot(f1, f1)
    c22 = wp.dot(f2, f2)
    c12 = wp.dot(f1, f2)

    # Divisions are issued first: their latency overlaps what follows.
    inverse_known = 1.0 / wp.max(known, LEAST_ENERGY)
    apart = large2 - small2
    inverse_apart = 1.0 / wp.max(apart, SLACK)
    peak = wp.max(known, t[2])
    reached = known + softening * (peak - known)
    soft = softening_factor(law, t[2], peak, inverse_known)
    stress_large = soft * t[0]
    stress_small = soft * t[1]
    linear = wp.where(apart > SLACK, (stress_large - stress_small) * inverse_apart, 0.0)
    isotropic = stress_large - linear * large2
    s11 = isotropic + linear * c11
    s22 = isotropic + linear * c22
    s12 = linear * c12

    hoop_rate, axial_rate = edges_of_quad(v0, v1, v2, v3)
    g1, g2 = gradient_of_quad(hoop_rate, axial_rate, b)
    viscous = law.viscosity / wp.max(0.5 * (c11 + c22), 0.25)
    s11 += viscous * wp.dot(f1, g1)
    s22 += viscous * wp.dot(f2, g2)
    s12 += viscous * 0.5 * (wp.dot(f1, g2) + wp.dot(f2, g1))

    p1 = volume * (f1 * s11 + f2 * s12)
    p2 = volume * (f1 * s12 + f2 * s22)
    pull_hoop = 0.5 * (p1 * b[0, 0] + p2 * b[0, 1])
    pull_axial = 0.5 * (p1 * b[1, 0] + p2 * b[1, 1])

    resist, more_hoop, more_axial = resistance_to_bow(
        law.hourglass_damping, h, hoop, axial, hoop_rate, axial_rate, x0, x1, x2, x3, v0, v1, v2, v3
    )
    pull_hoop += more_hoop
    pull_axial += more_axial
    return (
        pull_hoop + pull_axial + h[0] * resist,
        -pull_hoop + pull_axial + h[1] * resist,
        -pull_hoop - pull_axial + h[2] * resist,
        pull_hoop - pull_axial + h[3] * resist,
        reached,
    )


@wp.func
def volume_gradients_of_quad(x0: wp.vec3, x1: wp.vec3, x2: wp.vec3, x3: wp.vec3, origin: wp.vec3):
    """Return the exact gradients (m2) of the volume between a quad, a bilinear patch, and an origin by its
    four corners, which gas pushes on, and the volume (m3).
    """
    hoop, axial = edges_of_quad(x0, x1, x2, x3)
    normal = wp.cross(hoop, axial)
    bent = x0 - x1 + x2 - x3
    mean = 0.25 * normal
    hoopwise = wp.cross(hoop, bent) * (1.0 / 24.0)
    axialwise = wp.cross(bent, axial) * (1.0 / 24.0)
    return (
        mean - hoopwise - axialwise,
        mean + hoopwise - axialwise,
        mean + hoopwise + axialwise,
        mean - hoopwise + axialwise,
        wp.dot(0.25 * (x0 + x1 + x2 + x3) - origin, normal) * (1.0 / 3.0),
    )


@wp.func
def wall_of_quad(
    q: int, origin: wp.vec3, shared: int, mesh: Mesh, rubber: Rubber, forces: Forces, state: State
):
    """Write the force (N) of the wall on the four corners of a quad and the gradient of the volume (m2) by
    them, and return the volume (m3) between the quad and an origin.
    """
    c = vec4i_at(mesh.quads, q)
    mine = int_at(rubber.quad_law, q)
    law = rubber.laws[mine]
    x0 = coherent_vec3(state.x, c[0], shared)
    x1 = coherent_vec3(state.x, c[1], shared)
    x2 = coherent_vec3(state.x, c[2], shared)
    x3 = coherent_vec3(state.x, c[3], shared)
    # Prefetch: loads of the velocities overlap those of the positions.
    v0 = coherent_vec3(state.v, c[0], shared)
    v1 = coherent_vec3(state.v, c[1], shared)
    v2 = coherent_vec3(state.v, c[2], shared)
    v3 = coherent_vec3(state.v, c[3], shared)
    b = mat22_at(rubber.rest_inverse, q)
    large2, small2 = stretches_of_quad(x0, x1, x2, x3, b)
    t = wp.vec3(0.0)
    if large2 > 1.0:
        t = membrane_law(law, rubber.curves, followed_stretches(law, large2, small2))
    f0, f1, f2, f3, reached = forces_of_quad(
        law,
        b,
        vec4_at(rubber.hourglass, q),
        float_at(rubber.rubber_volume, q),
        float_at(rubber.softening_rate, mine),
        float_at(rubber.peak_energy, q),
        large2,
        small2,
        t,
        x0,
        x1,
        x2,
        x3,
        v0,
        v1,
        v2,
        v3,
    )
    put_float(rubber.peak_energy, q, reached)
    store_soa(forces.corner_force, q, 0, f0)
    store_soa(forces.corner_force, q, 1, f1)
    store_soa(forces.corner_force, q, 2, f2)
    store_soa(forces.corner_force, q, 3, f3)
    l0, l1, l2, l3, volume = volume_gradients_of_quad(x0, x1, x2, x3, origin)
    store_soa(forces.volume_gradient, q, 0, l0)
    store_soa(forces.volume_gradient, q, 1, l1)
    store_soa(forces.volume_gradient, q, 2, l2)
    store_soa(forces.volume_gradient, q, 3, l3)
    return volume


@wp.func
def stretch_of_quad(
    q: int, quads: wp.array[wp.vec4i], rest_inverse: wp.array[wp.mat22], x: wp.array[wp.vec3]
):
    """Return the largest principal stretch of a quad's mean deformation."""
    c = vec4i_at(quads, q)
    b = mat22_at(rest_inverse, q)
    hoop, axial = edges_of_quad(vec3_at(x, c[0]), vec3_at(x, c[1]), vec3_at(x, c[2]), vec3_at(x, c[3]))
    f1, f2 = gradient_of_quad(hoop, axial, b)
    large2, _ = squared_stretches(f1, f2)
    return wp.sqrt(large2)


@wp.kernel
def vertex_stretch(
    travel_limit: float,
    mesh: Mesh,
    balloons: Balloons,
    rest_inverse: wp.array[wp.mat22],
    checks: Checks,
    state: State,
):
    """Write the largest principal stretch of the wall at every vertex, the mean over its quads, and mark the
    sculptures in which something may be wrong.
    """
    i = wp.tid()
    total = float(0.0)
    count = float(0.0)
    row = int(i)
    while row >= 0:
        slots = vec4i_at(mesh.corners, row)
        for k in range(4):
            if slots[k] >= 0:
                total += stretch_of_quad(slots[k] // 4, mesh.quads, rest_inverse, state.x)
                count += 1.0
        row = -2 - slots[3]
    mean = total / wp.max(count, 1.0)
    put_float(checks.stretch, i, mean)
    check_vertex(i, mean, travel_limit, mesh, balloons, checks, state)
