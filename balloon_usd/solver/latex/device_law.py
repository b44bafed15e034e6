"""Rubber laws as the kernels take them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.kernels.arrays.rows import Law
from balloon_usd.solver.latex.membrane_data import step_viscosity

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.rubber import Rubber

MEMBRANE_DAMPING = 0.35
"""Damping of the fastest mesh mode, share of critical."""
STRETCH_LIMIT = 9.0
"""Stretch up to which rubber laws are followed: beyond burst (7 to 7.5) they only need to stay finite."""
STRESS_OCTAVES = 100.0
"""Doublings of stress up to which they are followed, where a float can still hold it."""
LEAST_KNOTS = 16
"""Least spline knots of a curve per doubling of the squared stretch."""
STEP_POWER = 1.0 / 6.0
"""Largest product of a knot's share of a doubling and the largest power of the squared stretch: cubics then
are off by less than a float's last digits.
"""
MANTISSA_BITS, EXPONENT_BIAS = 23, 127
"""Layout of a float."""


@dataclass(frozen=True)
class CurveGrid:
    """Spline knots of a curve: evenly spaced within every doubling of the squared stretch."""

    most: float
    """Largest squared stretch."""
    first_octave: int
    """Power of two of the smallest squared stretch."""
    octaves: int
    """Doublings."""
    each: int
    """CurveGrid in one of them, a power of two."""

    @property
    def squared(self) -> NDArray[np.float64]:
        """Squared stretches at all knots and at the end of the last step, (K + 1,)."""
        step = np.arange(self.octaves * self.each + 1)
        octave = np.exp2(self.first_octave + step // self.each)
        return np.asarray(octave * (1.0 + (step % self.each) / self.each), dtype=np.float64)


def device_laws(rubbers: Sequence[Rubber], dt: float) -> tuple[list[Law], NDArray[np.float32]]:
    """Return rubbers as the kernels take them, and the curves of all that differ, (K, 2, 4) float32."""
    first: dict[Rubber, int] = {}
    curves: list[NDArray[np.float32]] = []
    for rubber in rubbers:
        if rubber not in first:
            first[rubber] = sum(len(curve) for curve in curves)
            curves.append(ogden_curve(rubber))
    return [_device_law(rubber, dt, first[rubber]) for rubber in rubbers], np.concatenate(curves)


def curve_grid(rubber: Rubber) -> CurveGrid:
    """Return the spline knots of the curve of a rubber."""
    power = 0.5 * max(map(abs, rubber.alpha), default=1.0)
    most = min(STRETCH_LIMIT**2, 2.0 ** (STRESS_OCTAVES / power))
    # Where both stretches in the wall are at their limit, it is as thin as can be.
    first = math.floor(math.log2(most**-2.0))
    each = max(LEAST_KNOTS, 2 ** math.ceil(math.log2(power / STEP_POWER)))
    return CurveGrid(most, first, math.ceil(math.log2(most)) - first, each)


def ogden_curve(rubber: Rubber) -> NDArray[np.float32]:
    """Return the sums over a rubber's Ogden terms of mu stretch^alpha (Pa) and mu / alpha (stretch^alpha - 1)
    (J/m3) as cubics of the squared stretch between knots (Hermite), (K, 2, 4) float32.
    """
    squared = curve_grid(rubber).squared
    mu, half = np.array(rubber.mu)[:, None], 0.5 * np.array(rubber.alpha)[:, None]
    # Beyond the knot after the last stretch that is followed it need only stay a number.
    power = mu * np.minimum(squared**half, 2.0 ** (STRESS_OCTAVES + 1.0))
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


def _device_law(rubber: Rubber, dt: float, first_segment: int) -> Law:
    """Return a rubber, given the first segment of its curve."""
    law, grid = Law(), curve_grid(rubber)
    law.first_segment, law.last_segment = first_segment, first_segment + grid.octaves * grid.each - 1
    law.zero_segment = first_segment - (grid.first_octave + EXPONENT_BIAS) * grid.each
    law.step_bits = MANTISSA_BITS - (grid.each.bit_length() - 1)
    law.step_share = 0.5**law.step_bits
    law.most = grid.most
    law.gent_mu, law.gent_limit = rubber.gent_mu, min(rubber.gent_limit, 1e9)
    if rubber.softening is not None:
        law.soft_depth, law.soft_steepness = 1.0 / rubber.softening.r, 1.0 / rubber.softening.c
    law.viscosity = step_viscosity(rubber, dt, MEMBRANE_DAMPING)
    law.hourglass_damping = MEMBRANE_DAMPING * dt
    return law
