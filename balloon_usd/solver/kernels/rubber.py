"""Rubber laws on the device: principal stresses of an incompressible membrane."""

import warp as wp


@wp.struct
class Law:
    """One rubber: Ogden terms and a Gent term, softening, and the numerical guards that go with them."""

    mu: wp.vec3
    """Ogden moduli, Pa."""
    alpha: wp.vec3
    """Ogden exponents."""
    mu_per_alpha: wp.vec3
    """Ogden moduli over exponents, Pa."""
    gent_mu: float
    """Modulus of the Gent term, Pa; 0 leaves it out."""
    gent_limit: float
    """Gent's Jm: the largest I1 - 3."""
    soft_depth: float
    """1/r of Ogden & Roxburgh 1999; 0 switches softening off."""
    soft_width: float
    """c of Ogden & Roxburgh 1999."""
    log_limit: float
    """Logarithm of the stretch at which the law is continued by its value, so that locking stays below a
    few times the rest stiffness.
    """
    viscosity: float
    """Resistance to the rate of strain, Pa s."""
    hourglass_damping: float
    """Damping of the hourglass mode per stiffness, s."""


GENT_NEAR_LIMIT = wp.constant(0.9)
"""Share of Jm at which the Gent term is continued by its value: beyond it the law would lock."""
ERF_1 = wp.constant(0.0705230784)
ERF_2 = wp.constant(0.0422820123)
ERF_3 = wp.constant(0.0092705272)
ERF_4 = wp.constant(0.0001520143)
ERF_5 = wp.constant(0.0002765672)
ERF_6 = wp.constant(0.0000430638)
"""Abramowitz & Stegun 7.1.28: erf to 3e-7, without an exponential."""


@wp.func
def ogden_membrane(law: Law, log_large: float, log_small: float):
    """Return (large dW/dlarge, small dW/dsmall, W) in Pa, Pa, J/m3 from the logarithms of two stretches
    (Ogden 1972; Gent 1996).
    """
    log_a = wp.min(log_large, law.log_limit)
    log_b = wp.min(log_small, law.log_limit)
    t1 = float(0.0)
    t2 = float(0.0)
    energy = float(0.0)
    for k in range(3):
        if law.mu[k] != 0.0:
            ea = wp.exp(law.alpha[k] * log_a)
            eb = wp.exp(law.alpha[k] * log_b)
            ec = 1.0 / (ea * eb)
            t1 += law.mu[k] * (ea - ec)
            t2 += law.mu[k] * (eb - ec)
            energy += law.mu_per_alpha[k] * (ea + eb + ec - 3.0)
    if law.gent_mu > 0.0:
        a2 = wp.exp(2.0 * log_a)
        b2 = wp.exp(2.0 * log_b)
        c2 = 1.0 / (a2 * b2)
        used = wp.min((a2 + b2 + c2 - 3.0) / law.gent_limit, GENT_NEAR_LIMIT)
        modulus = law.gent_mu / (1.0 - used)
        t1 += modulus * (a2 - c2)
        t2 += modulus * (b2 - c2)
        energy += -0.5 * law.gent_mu * law.gent_limit * wp.log(1.0 - used)
    return wp.vec3(t1, t2, energy)


@wp.func
def softening_factor(law: Law, energy: float, peak: float):
    """Return Ogden & Roxburgh's factor on the stress after a peak energy (1999, their eq. for eta)."""
    factor = float(1.0)
    if law.soft_depth > 0.0:
        if peak > energy:
            z = (peak - energy) / (law.soft_width * peak)
            z3 = z * z * z
            t = 1.0 + z * (ERF_1 + z * ERF_2) + z3 * ((ERF_3 + z * ERF_4) + z * z * (ERF_5 + z * ERF_6))
            t2 = t * t
            t4 = t2 * t2
            t8 = t4 * t4
            factor = 1.0 - law.soft_depth * (1.0 - 1.0 / (t8 * t8))
    return factor
