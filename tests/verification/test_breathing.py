"""V15: how fast gas and wall breathe when neither carries more than its own mass."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import gauge_pressure, maxwell_state, sphere_pressure
from tests.verification.setups import Rig, cube_sphere, plain, stretched, tube

SIZE, LATEX, NEO_HOOKE = size_named("260"), plain(rubber_named()), plain(rubber_named("neo-hooke"))
DT = 1.0e-6
"""Time step, s: a hundred and more a period, so that its own error is below 0.1 %."""
ACROSS = np.array([0.0, 1.0, 1.0])
"""Directions in which a tube along x breathes."""


def tube_frequency(a, b, pressure):
    """Frequency at which a 260 of fixed length breathes, Hz, after rho h0 R0 a'' = p a b - W_a h0 / R0."""
    wall = float(LATEX.stiffness(a, b)[0]) * SIZE.thickness / SIZE.radius
    # Isothermal gas: (p + p0) a^2 stays as it is.
    gas = b * (2.0 * (pressure + ATMOSPHERE) - pressure)
    return math.sqrt((wall + gas) / (LATEX.density * SIZE.thickness * SIZE.radius)) / (2.0 * math.pi)


def tube_rig(a, b, pressure):
    """Hold a short piece of a 260 at its length, its gas sealed in."""
    mesh = tube(SIZE.radius, 28, 0.3 * SIZE.radius * np.arange(4.0))
    gauge = (0.0, pressure, 0.0)
    rig = Rig(mesh, LATEX, SIZE.thickness, gauge=gauge, vented=(0, 2), dt=DT, substeps=2, scale_mass=False)
    rig.place(stretched(mesh, a, b))
    rig.fill(1, pressure)
    rig.hold_length()
    return rig


def ring_up(rig, velocity, seconds):
    """Strike a rig with a velocity (V, 3), m/s; return times (s) and how far it is displaced along it, (N,)."""
    rig.scene.v.assign(velocity.astype(np.float32))
    weight = velocity / (velocity[rig.wall] ** 2).sum()
    start, times, found = rig.points, [0.0], [0.0]
    frame = rig.stepper.substeps * rig.scene.settings.dt
    for k in range(1, round(seconds / frame) + 1):
        rig.advance()
        times.append(k * frame)
        found.append(float((weight * (rig.points - start))[rig.wall].sum()))
    return np.array(times), np.array(found)


def upward_crossings(times, values):
    """When a signal passes its mean upwards, s."""
    signal = values - values.mean()
    before = np.flatnonzero((signal[:-1] < 0.0) & (signal[1:] >= 0.0))
    share = signal[before] / (signal[before] - signal[before + 1])
    return times[before] + share * (times[before + 1] - times[before])


def test_an_inflated_260_breathes_at_the_frequency_of_theory(verify):
    state = maxwell_state(LATEX)
    pressure = gauge_pressure(SIZE, state.p_star)
    a, b = state.bulged.a, state.bulged.b
    theory = tube_frequency(a, b, pressure)
    assert theory == pytest.approx(5629.0, rel=1e-3)
    rig = tube_rig(a, b, pressure)
    times, values = ring_up(rig, 1.0 * rig.points / SIZE.radius * ACROSS, 10.0 / theory)
    beats = upward_crossings(times, values)
    assert len(beats) >= 9
    verify("V15", "inflated 260, breathing, Hz", 1.0 / np.diff(beats).mean(), theory, 2e-2)


def test_a_flat_260_swells_and_comes_back_in_half_a_period_of_theory(verify):
    theory = tube_frequency(1.0, 1.0, 0.0)
    assert theory == pytest.approx(3008.0, rel=1e-3)
    rig = tube_rig(1.0, 1.0, 0.0)
    # Only outwards: on its way in the wall wrinkles, and the gas alone is softer.
    times, values = ring_up(rig, 0.2 * rig.points / SIZE.radius * ACROSS, 0.8 / theory)
    back = int(np.flatnonzero(values[1:] < 0.0)[0]) + 1
    share = values[back - 1] / (values[back - 1] - values[back])
    half = times[back - 1] + share * (times[back] - times[back - 1])
    verify("V15", "flat 260, breathing outwards, Hz", 0.5 / half, theory, 2e-2)


def test_a_neo_hookean_sphere_breathes_at_the_frequency_of_theory(verify):
    # rho h0 r0 l'' = p l^2 - 2 W_a h0 / r0, the gas isothermal: (p + p0) l^3 stays as it is.
    radius, thickness, stretch = 0.02, 0.2e-3, 1.2
    mesh = cube_sphere(radius, 8)
    pressure = float(sphere_pressure(NEO_HOOKE, stretch)) * thickness / radius
    same, cross, _ = NEO_HOOKE.stiffness(stretch, stretch)
    wall = 2.0 * float(same + cross) * thickness / radius
    gas = stretch * (3.0 * (pressure + ATMOSPHERE) - 2.0 * pressure)
    theory = math.sqrt((wall + gas) / (NEO_HOOKE.density * thickness * radius)) / (2.0 * math.pi)
    rig = Rig(mesh, NEO_HOOKE, thickness, dt=4.0 * DT, substeps=2, scale_mass=False)
    rig.place(stretch * mesh.points)
    rig.fill(0, pressure)
    times, values = ring_up(rig, 1.0 * mesh.points / radius, 6.0 / theory)
    beats = upward_crossings(times, values)
    assert len(beats) >= 5
    verify(
        "V15",
        f"neo-Hooke sphere, stretch {stretch}, breathing, Hz",
        1.0 / np.diff(beats).mean(),
        theory,
        2e-2,
    )
