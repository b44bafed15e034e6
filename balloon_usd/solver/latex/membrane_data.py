"""Constants of the wall's quads and vertices: rest shape, masses, hourglass vectors, neighbours."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.solver.latex.body import LatexBody

Floats = NDArray[np.float64]

STIFFENING = 2.6
"""Largest tangent stiffness met on the way, in rest stiffnesses 4 mu0 (bulged and softened K&C latex:
2.3).
"""
MASS_SAFETY = 1.35
"""Reserve of the scaled mass over the stability limit of symplectic Euler, for damping and contact."""
SKEWED = 0.75
"""By how much of its stiffness skew may make a face stiffer before its mass counts that: the reserve bears
0.7, as in the caps of tubes. In the cleft of a heart it is 2.2.
"""
HOURGLASS = 0.1
"""Stiffness of the hourglass mode as a share of the wall's own."""
GAS_AREA_GAIN = 24.0
"""Growth of wall area from flat to bulged: the gas spring acts on the grown area (K&C: 5.66 x 4.15)."""


@dataclass(frozen=True)
class MembraneData:
    """Per-quad and per-vertex constants of one balloon."""

    rest_inverse: Floats
    """Inverse rest edges, (Q, 2, 2), 1/m: deformation gradient = edges times this."""
    rubber_volume: Floats
    """Volume of rubber, (Q,), m3."""
    hourglass: Floats
    """Hourglass vectors scaled by the square root of their stiffness, (Q, 4), (N/m)^1/2."""
    mass: Floats
    """Inertial mass, (V,), kg."""
    true_mass: Floats
    """Mass of the rubber, (V,), kg."""


def membrane_data(body: LatexBody, dt: float, atmosphere: float, *, scale_mass: bool) -> MembraneData:
    """Return the wall's constants for a time step of `dt` seconds.

    With `scale_mass` every vertex gets the mass that makes this step stable (selective mass scaling):
    twisting is
    quasi-static, so the added inertia does not show. Without it the rubber has its own mass.
    """
    p = body.rest[body.quads]
    hoop = 0.5 * (p[:, 1] - p[:, 0] + p[:, 2] - p[:, 3])
    axial = 0.5 * (p[:, 3] - p[:, 0] + p[:, 2] - p[:, 1])
    width = np.linalg.norm(hoop, axis=1)
    e1 = hoop / width[:, None]
    shear = np.sum(axial * e1, axis=1)
    height = np.linalg.norm(axial - shear[:, None] * e1, axis=1)
    zero = np.zeros_like(width)
    # Rest edges as columns ((width, shear), (0, height)), inverted.
    rest_inverse = np.stack(
        [np.stack([1 / width, -shear / (width * height)], -1), np.stack([zero, 1 / height], -1)], axis=1
    )
    area = width * height
    volume = area * body.thickness
    stiffness = 4.0 * body.rubber.shear_modulus
    spring = HOURGLASS / 3.0 * stiffness * body.thickness * (width / height + height / width)
    hourglass = _hourglass(p, hoop, axial, spring)
    density = body.rubber.density * body.thickness
    if scale_mass:
        tangent = STIFFENING * stiffness * body.thickness
        straight, skew = 1 / width**2 + 1 / height**2, (shear / (width * height)) ** 2
        wall = dt**2 * tangent * (straight + np.where(skew > SKEWED * straight, skew, 0.0))
        radius = min(body.radius, math.sqrt(GAS_AREA_GAIN) * body.gap)
        gas = dt**2 / 4 * 2 * atmosphere / radius * GAS_AREA_GAIN / math.sqrt(GAS_AREA_GAIN)
        inertia = np.maximum(density, MASS_SAFETY * (wall + gas))
    else:
        inertia = density
    vertices = len(body.points)
    mass, true_mass = np.zeros(vertices), np.zeros(vertices)
    for k in range(4):
        np.add.at(mass, body.quads[:, k], 0.25 * inertia * area)
        np.add.at(true_mass, body.quads[:, k], 0.25 * density * area)
    return MembraneData(rest_inverse, volume, hourglass, mass, true_mass)


def _hourglass(p: Floats, hoop: Floats, axial: Floats, spring: Floats) -> Floats:
    """Hourglass vectors orthogonal to every linear motion (Flanagan & Belytschko 1981), (Q, 4)."""
    pattern = np.array([1.0, -1.0, 1.0, -1.0])
    bow = np.einsum("i,qid->qd", pattern, p)
    gram = np.stack([hoop, axial], axis=1) @ np.stack([hoop, axial], axis=2)
    parts = np.linalg.solve(gram, np.einsum("qkd,qd->qk", np.stack([hoop, axial], axis=1), bow)[..., None])[
        ..., 0
    ]
    hoop_sign, axial_sign = 0.5 * np.array([-1.0, 1.0, 1.0, -1.0]), 0.5 * np.array([-1.0, -1.0, 1.0, 1.0])
    vector = pattern - parts[:, :1] * hoop_sign - parts[:, 1:] * axial_sign
    return 0.5 * vector * np.sqrt(spring)[:, None]


def step_viscosity(rubber: Rubber, dt: float, ratio: float) -> float:
    """Return the viscosity (Pa s) that damps the mesh's fastest mode by this ratio of critical."""
    return ratio * 4.0 * STIFFENING * rubber.shear_modulus * dt
