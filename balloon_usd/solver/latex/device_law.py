"""Rubber laws as the kernels take them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.kernels.rubber import CURVE_KNOTS, FIRST_OCTAVE, OCTAVE_KNOTS, Law
from balloon_usd.solver.latex.membrane_data import step_viscosity

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.rubber import Rubber

MEMBRANE_DAMPING = 0.35
"""Damping of the fastest mesh mode, share of critical."""
STRETCH_LIMIT = 9.0
"""Stretch up to which rubber laws are followed: beyond burst (7 to 7.5) they only need to stay finite."""


def device_laws(rubbers: Sequence[Rubber], dt: float) -> tuple[list[Law], NDArray[np.float32]]:
    """Return rubbers as the kernels take them, and the curves of all that differ, (knots, 2, 4) float32."""
    found: list[Rubber] = []
    for rubber in rubbers:
        if rubber not in found:
            found.append(rubber)
    curves = np.concatenate([ogden_curve(rubber) for rubber in found])
    return [_device_law(rubber, dt, CURVE_KNOTS * found.index(rubber)) for rubber in rubbers], curves


def ogden_curve(rubber: Rubber) -> NDArray[np.float32]:
    """Return the sums over a rubber's Ogden terms of mu stretch^alpha (Pa) and mu / alpha (stretch^alpha - 1)
    (J/m3) as cubics between knots (Hermite) of the squared stretch, (CURVE_KNOTS, 2, 4) float32.
    """
    step = np.arange(CURVE_KNOTS + 1)
    octave = 2.0 ** (FIRST_OCTAVE + step // OCTAVE_KNOTS)
    squared = octave * (1.0 + (step % OCTAVE_KNOTS) / OCTAVE_KNOTS)
    mu, half = np.array(rubber.mu)[:, None], 0.5 * np.array(rubber.alpha)[:, None]
    power = mu * squared**half
    stress, stress_slope = power.sum(axis=0), (half * power).sum(axis=0) / squared
    energy = (0.5 / half * (power - mu)).sum(axis=0)
    curves = np.stack([stress, energy], axis=1)
    slopes = np.stack([stress_slope, 0.5 * stress / squared], axis=1)
    width = np.diff(squared)[:, None]
    here, there = curves[:-1], curves[1:]
    begin, end = slopes[:-1] * width, slopes[1:] * width
    rise = there - here
    cubic = np.stack([here, begin, 3.0 * rise - 2.0 * begin - end, begin + end - 2.0 * rise], axis=2)
    return cubic.astype(np.float32)


def _device_law(rubber: Rubber, dt: float, curve: int) -> Law:
    """Return a rubber whose curve begins at a knot."""
    law = Law()
    law.curve, law.most = curve, STRETCH_LIMIT**2
    law.gent_mu, law.gent_limit = rubber.gent_mu, min(rubber.gent_limit, 1e9)
    if rubber.softening is not None:
        law.soft_depth, law.soft_width = 1.0 / rubber.softening.r, rubber.softening.c
    law.viscosity = step_viscosity(rubber, dt, MEMBRANE_DAMPING)
    law.hourglass_damping = MEMBRANE_DAMPING * dt
    return law
