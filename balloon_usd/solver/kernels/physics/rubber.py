"""Rubber laws on the device: principal stresses of an incompressible membrane."""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import CurveSegment, Law
from balloon_usd.solver.kernels.device.native import native

GENT_NEAR_LIMIT = wp.constant(0.9)
"""Share of Jm at which the Gent term is continued by its value: beyond it the law would lock."""
LEAST_ENERGY = wp.constant(1.0)
"""Energy below which rubber counts as new, J/m3: a ten-millionth of what a bubble holds."""
ERF_1 = wp.constant(0.0705230784)
ERF_2 = wp.constant(0.0422820123)
ERF_3 = wp.constant(0.0092705272)
ERF_4 = wp.constant(0.0001520143)
ERF_5 = wp.constant(0.0002765672)
ERF_6 = wp.constant(0.0000430638)
"""Abramowitz & Stegun 7.1.28: erf to 3e-7, without an exponential."""


@native("return curves.data[i];")
def curve_segment_at(curves: wp.array[CurveSegment], i: int) -> CurveSegment:
    """Return a segment, unchecked."""
    return curves[i]


@wp.func
def on_curve(law: Law, curves: wp.array[CurveSegment], squared: float):
    """Return the Ogden sums of mu stretch^alpha (Pa) and mu / alpha (stretch^alpha - 1) (J/m3) at a squared
    stretch.

    The exponent of a float counts octaves and its leading mantissa bits even steps within them: together they
    are the index of the segment.
    """
    bits = wp.cast(squared, wp.int32)
    t = float(bits & ((1 << law.step_bits) - 1)) * law.step_share
    segment = wp.clamp(law.zero_segment + (bits >> law.step_bits), law.first_segment, law.last_segment)
    c = curve_segment_at(curves, segment)
    return wp.vec2(
        ((c[0, 3] * t + c[0, 2]) * t + c[0, 1]) * t + c[0, 0],
        ((c[1, 3] * t + c[1, 2]) * t + c[1, 1]) * t + c[1, 0],
    )


@wp.func
def followed_stretches(law: Law, large2: float, small2: float):
    """Return the squares of the three principal stretches at which a law is taken, given those of two.

    The smaller one does not count below what uniaxial tension gives: there the wall wrinkles instead of
    pushing (tension field).
    """
    a2 = wp.min(large2, law.most)
    b2 = wp.min(small2, law.most)
    b2 = wp.where(b2 * b2 * a2 < 1.0, 1.0 / wp.sqrt(a2), b2)
    return wp.vec3(a2, b2, 1.0 / (a2 * b2))


@wp.func
def membrane_law(law: Law, curves: wp.array[CurveSegment], squared: wp.vec3):
    """Return dW/dlarge over large, dW/dsmall over small (Pa) and W (J/m3) from the squares of three stretches
    (Ogden 1972; Gent 1996).
    """
    a2 = squared[0]
    b2 = squared[1]
    c2 = squared[2]
    a = on_curve(law, curves, a2)
    b = on_curve(law, curves, b2)
    c = on_curve(law, curves, c2)
    t1 = a[0] - c[0]
    t2 = b[0] - c[0]
    energy = a[1] + b[1] + c[1]
    if law.gent_mu > 0.0:
        used = wp.min((a2 + b2 + c2 - 3.0) / law.gent_limit, GENT_NEAR_LIMIT)
        modulus = law.gent_mu / (1.0 - used)
        t1 += modulus * (a2 - c2)
        t2 += modulus * (b2 - c2)
        energy += -0.5 * law.gent_mu * law.gent_limit * wp.log(1.0 - used)
    # One over a2 and over b2, without dividing again.
    return wp.vec3(t1 * (b2 * c2), t2 * (a2 * c2), energy)


@wp.func
def softening_factor(law: Law, energy: float, peak: float, inverse_peak: float):
    """Return Ogden & Roxburgh's factor on the stress after a peak energy (1999, their eq. for eta), all in
    J/m3.
    """
    z = (1.0 - energy * inverse_peak) * law.soft_steepness
    z3 = z * z * z
    t = 1.0 + z * (ERF_1 + z * ERF_2) + z3 * ((ERF_3 + z * ERF_4) + z * z * (ERF_5 + z * ERF_6))
    t2 = t * t
    t4 = t2 * t2
    t8 = t4 * t4
    factor = 1.0 - law.soft_depth * (1.0 - 1.0 / (t8 * t8))
    return wp.where(peak > LEAST_ENERGY and peak > energy, factor, 1.0)
