"""Rubber laws on the device: principal stresses of an incompressible membrane."""

import warp as wp


@wp.struct
class Law:
    """One rubber: Ogden terms and a Gent term, softening, and the numerical guards that go with them."""

    mu: wp.vec3
    """Ogden moduli, Pa."""
    alpha: wp.vec3
    """Ogden exponents."""
    gent_mu: float
    """Modulus of the Gent term, Pa; 0 leaves it out."""
    gent_limit: float
    """Gent's Jm: the largest I1 - 3."""
    soft_depth: float
    """1/r of Ogden & Roxburgh 1999; 0 switches softening off."""
    soft_width: float
    """c of Ogden & Roxburgh 1999."""
    stretch_limit: float
    """Stretch at which the law is continued by its value, so that locking stays below a few times the rest stiffness."""
    viscosity: float
    """Resistance to the rate of strain, Pa s."""
    hourglass_damping: float
    """Damping of the hourglass mode per stiffness, s."""


GENT_NEAR_LIMIT = wp.constant(0.9)
"""Share of Jm at which the Gent term is continued by its value: beyond it the law would lock."""
ERF_P = wp.constant(0.47047)
ERF_1 = wp.constant(0.3480242)
ERF_2 = wp.constant(-0.0958798)
ERF_3 = wp.constant(0.7478556)
"""Abramowitz & Stegun 7.1.25: erf to 2.5e-5."""


@wp.func
def ogden_membrane(law: Law, large: float, small: float):
    """Return (large dW/dlarge, small dW/dsmall, W) in Pa, Pa, J/m3 (Ogden 1972; Gent 1996)."""
    a = wp.min(large, law.stretch_limit)
    b = wp.min(small, law.stretch_limit)
    log_a = wp.log(a)
    log_b = wp.log(b)
    log_c = -(log_a + log_b)
    t1 = float(0.0)
    t2 = float(0.0)
    energy = float(0.0)
    for k in range(3):
        if law.mu[k] != 0.0:
            ea = wp.exp(law.alpha[k] * log_a)
            eb = wp.exp(law.alpha[k] * log_b)
            ec = wp.exp(law.alpha[k] * log_c)
            t1 += law.mu[k] * (ea - ec)
            t2 += law.mu[k] * (eb - ec)
            energy += law.mu[k] / law.alpha[k] * (ea + eb + ec - 3.0)
    if law.gent_mu > 0.0:
        a2 = a * a
        b2 = b * b
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
        if peak > 0.0:
            z = (peak - energy) / (law.soft_width * peak)
            t = 1.0 / (1.0 + ERF_P * z)
            erf = 1.0 - t * (ERF_1 + t * (ERF_2 + t * ERF_3)) * wp.exp(-z * z)
            factor = 1.0 - law.soft_depth * erf
    return factor
