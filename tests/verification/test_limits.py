"""V02, V03: where the pressure of a sphere is highest and lowest, and for which rubbers it has such limits."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from balloon_usd.balloon.rubber import Rubber
from balloon_usd.balloon.tube_theory import sphere_pressure
from tests.verification.setups import Rig, cube_sphere

RADIUS, THICKNESS, CELLS = 0.02, 0.2e-3, 6
MODULUS = 300e3
"""Shear modulus of every rubber here, Pa."""


def mooney_rivlin(ratio):
    """The rubber with this C2 / C1; 0 is neo-Hooke."""
    first = MODULUS / (1.0 + ratio)
    if ratio == 0.0:
        return Rubber("neo-hooke", mu=(first,), alpha=(2.0,), softening=None)
    return Rubber("mooney-rivlin", mu=(first, -ratio * first), alpha=(2.0, -2.0), softening=None)


@cache
def swept(ratio, low, high, points=7):
    """Settle a sphere at several stretches, its gas sealed in; return them and the pressures p* / mu0."""
    rubber, mesh = mooney_rivlin(ratio), cube_sphere(RADIUS, CELLS)
    rig = Rig(mesh, rubber, THICKNESS)
    found = []
    for stretch in np.linspace(low, high, points):
        rig.place(stretch * mesh.points)
        rig.fill(0, float(sphere_pressure(rubber, stretch)) * THICKNESS / RADIUS)
        rig.settle(most=2000)
        size = np.linalg.norm(rig.points - rig.points.mean(axis=0), axis=1).mean() / RADIUS
        found.append((size, float(rig.array("pressure")[0]) * RADIUS / THICKNESS / MODULUS))
    return np.array(found).T


@pytest.mark.parametrize(
    ("case", "name", "ratio", "reach", "theory"),
    [
        ("V02", "neo-Hooke sphere, stretch of highest pressure", 0.0, (1.25, 1.55), 7 ** (1 / 6)),
        ("V03", "Mooney-Rivlin sphere, stretch of highest pressure", 0.1, (1.3, 1.7), 1.4762),
        ("V03", "Mooney-Rivlin sphere, stretch of lowest pressure", 0.1, (2.7, 3.6), 3.1427),
    ],
)
def test_the_pressure_of_a_sphere_turns_at_the_stretch_of_theory(verify, case, name, ratio, reach, theory):
    stretch, pressure = swept(ratio, *reach)
    turns = np.polynomial.Polynomial.fit(stretch, pressure, 4).deriv().roots()
    real = turns.real[np.abs(turns.imag) < 1e-6]
    inside = real[(real > reach[0]) & (real < reach[1])]
    assert len(inside) == 1, f"turns at {inside}"
    verify(case, name, inside[0], theory, 1e-2)


def test_a_sphere_has_limits_only_below_the_critical_ratio_of_its_two_moduli(verify):
    # p* is linear in C1 and C2: with C2 / C1 = k its slope is s1 + k s2 and first has no zero at k = max(-s1 / s2).
    reach = (1.6, 2.4)
    stretch, first = swept(0.0, *reach)
    also, both = swept(1.0, *reach)
    fine = np.linspace(1.65, 2.35, 200)
    slope_first, slope_both = (
        np.polynomial.Polynomial.fit(x, y, 5).deriv()(fine) for x, y in ((stretch, first), (also, both))
    )
    slope_second = 2.0 * slope_both - slope_first
    verify("V03", "critical C2 / C1 of a sphere", (-slope_first / slope_second).max(), 0.21446, 1e-2)
