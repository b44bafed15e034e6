"""The meridian of a pinched bubble by quadrature, at any pressure; the laws are told in `bubble_shape`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.roots import root
from balloon_usd.balloon.rubber import relaxed_stretches

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Floats, MembraneLaw

_MERIDIAN_NODES = 40
_LARGEST_AXIAL_STRETCH = 16.0


def bubble_at_stretch(
    law: MembraneLaw, p_star: Floats | float, widest: Floats, tube_stretch: float
) -> Floats:
    """Return (rest length / R0, length / R0, volume / R0^3) of bubbles, (3, N), nan where there is none.

    `widest`: hoop stretch at the middle, (N,). `tube_stretch`: hoop stretch of the tube that a long bubble
    approaches; it only places the quadrature's nodes. `p_star`: Pa, of all or of each, (N,).
    """
    middle = axial_stretch(law, widest, 0.5 * p_star * widest**2, axial_force=True)
    constant = legendre(law, widest, middle)
    # From the middle (t = 0) to the neck (t = 1); a long bubble changes slowly near its middle.
    slow = np.sqrt(np.maximum(1.0 - widest / tube_stretch, 1e-12))[:, None]
    node, weight = np.polynomial.legendre.leggauss(_MERIDIAN_NODES)
    span = np.arcsinh(1.0 / slow)
    t = slow * np.sinh(0.5 * span * (node + 1.0))
    weight = 0.5 * span * weight * slow * np.cosh(0.5 * span * (node + 1.0))
    a = widest[:, None] * (1.0 - t**2)
    da = 2.0 * widest[:, None] * t * weight
    b = axial_stretch(law, a, constant[:, None], axial_force=False)
    each = np.asarray(p_star).reshape(-1, 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        cosine = 0.5 * each * a**2 / law.nominal_stress(*relaxed_stretches(a, b))[1]
        sine = np.sqrt(1.0 - cosine**2)
        rest_length = 2.0 * np.sum(da / (b * sine), axis=1)
        length = 2.0 * np.sum(da * cosine / sine, axis=1)
        volume = 2.0 * math.pi * np.sum(da * a**2 * cosine / sine, axis=1)
    return np.stack([rest_length, length, volume])


def legendre(law: MembraneLaw, a: Floats, b: Floats) -> Floats:
    """Return W - b W_b of hoop and meridional stretches, Pa: constant along the meridian of a bubble."""
    energy, _, axial = law.energy_and_stress(*relaxed_stretches(a, b))
    return np.asarray(energy - b * axial)


def axial_stretch(law: MembraneLaw, a: Floats, wanted: Floats, *, axial_force: bool) -> Floats:
    """Return the meridional stretch b at which W_b, the axial force, or else W - b W_b is as wanted (Pa)."""

    def excess(b: Floats) -> Floats:
        if axial_force:
            return np.asarray(wanted - law.nominal_stress(*relaxed_stretches(a, b))[1])
        return np.asarray(legendre(law, a, b) - wanted)

    return root(excess, np.ones(a.shape), np.full(a.shape, _LARGEST_AXIAL_STRETCH))
