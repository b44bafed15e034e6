"""Rubber laws as the kernels take them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import warp as wp

from balloon_usd.solver.kernels.rubber import Law
from balloon_usd.solver.latex.membrane_data import step_viscosity

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Rubber

MEMBRANE_DAMPING = 0.35
"""Damping of the fastest mesh mode, share of critical."""
STRETCH_LIMIT = 9.0
"""Stretch up to which rubber laws are followed: beyond burst (7 to 7.5) they only need to stay finite."""


def device_law(rubber: Rubber, dt: float) -> Law:
    """Return a rubber as the kernels take it.

    Raises:
        ValueError: the rubber has more than three Ogden terms.
    """
    if len(rubber.mu) > 3:
        raise ValueError(f"rubber {rubber.name}: at most three Ogden terms, got {len(rubber.mu)}")
    law = Law()
    law.mu = wp.vec3(*rubber.mu, *[0.0] * (3 - len(rubber.mu)))
    law.alpha = wp.vec3(*rubber.alpha, *[1.0] * (3 - len(rubber.mu)))
    law.mu_per_alpha = wp.vec3(*[m / k for m, k in zip(law.mu, law.alpha, strict=True)])
    law.gent_mu, law.gent_limit = rubber.gent_mu, min(rubber.gent_limit, 1e9)
    if rubber.softening is not None:
        law.soft_depth, law.soft_width = 1.0 / rubber.softening.r, rubber.softening.c
    law.log_limit = math.log(STRETCH_LIMIT)
    law.viscosity = step_viscosity(rubber, dt, MEMBRANE_DAMPING)
    law.hourglass_damping = MEMBRANE_DAMPING * dt
    return law
