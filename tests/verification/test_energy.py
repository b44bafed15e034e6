"""V17: a bubble of true mass that is struck and let go gains no energy, no momentum and no spin."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.balloon.air import ATMOSPHERE, GAS_CONSTANT, ROOM_TEMPERATURE
from balloon_usd.balloon.rubber import relaxed_stretches, rubber_named
from balloon_usd.balloon.tube_theory import sphere_pressure
from tests.verification.setups import Rig, cube_sphere, plain

RADIUS, THICKNESS, CELLS, STRETCH = 0.02, 0.2e-3, 6, 3.0
LATEX = plain(rubber_named())
DT = 5.0e-6
"""Time step, s: without scaled masses it must resolve the fastest wave of the mesh."""
LOOKS = 2000
"""Looks at the energy, one after every second step."""
STRIKE, SPIN = 1.0, 40.0
"""Speed of the strike, m/s, and rate of the turn, rad/s."""
WAVE_SPEED = 33.0
"""Slowest wave in the rubber, m/s: the measure of its speeds."""


def struck(substeps, dt):
    """A blown-up sphere of true mass that was pushed, bent, shaken and spun."""
    mesh = cube_sphere(RADIUS, CELLS)
    rig = Rig(mesh, LATEX, THICKNESS, dt=dt, substeps=substeps, scale_mass=False)
    rig.place(STRETCH * mesh.points)
    rig.fill(0, float(sphere_pressure(LATEX, STRETCH)) * THICKNESS / RADIUS)
    velocity = np.random.default_rng(5).normal(size=mesh.points.shape)
    velocity[:, 0] += 3.0 * (mesh.points[:, 1] / RADIUS) ** 2
    velocity = STRIKE * velocity + np.cross([0.0, 0.0, SPIN], rig.points)
    rig.scene.v.assign(velocity.astype(np.float32))
    return rig


def potential(rig):
    """Energy of wall and gas, J."""
    corners = rig.points[rig.mesh.quads]
    hoop = 0.5 * (corners[:, 1] - corners[:, 0] + corners[:, 2] - corners[:, 3])
    axial = 0.5 * (corners[:, 3] - corners[:, 0] + corners[:, 2] - corners[:, 1])
    gradient = np.stack([hoop, axial], axis=2) @ rig.array("rest_inverse")
    small, large = np.sqrt(np.linalg.eigvalsh(gradient.transpose(0, 2, 1) @ gradient)).T
    wall = (rig.array("rubber_volume") * LATEX.energy(*relaxed_stretches(large, small))).sum()
    bow = np.einsum("qk,qkd->qd", rig.array("hourglass"), corners)
    c = corners - corners[0, 0]
    room = (c.mean(axis=1) * np.cross(c[:, 2] - c[:, 0], c[:, 3] - c[:, 1])).sum() / 6.0
    heat = float(rig.array("amount")[0]) * GAS_CONSTANT * ROOM_TEMPERATURE
    return wall + 0.5 * (bow**2).sum() + ATMOSPHERE * room - heat * math.log(room)


@pytest.fixture(scope="module")
def energies():
    """Kinetic energy and all energy at every look, (LOOKS,) each, J."""
    rig = struck(2, DT)
    mass = rig.array("mass")
    rig.advance()
    stored, speed, kinetic, total = potential(rig), rig.array("v"), [], []
    for _ in range(LOOKS):
        rig.advance()
        later = rig.array("v")
        # Positions are those half a step after their velocities, and the next look comes two steps later.
        now = 0.75 * speed + 0.25 * later
        kinetic.append(0.5 * float((mass * (now**2).sum(axis=1)).sum()))
        total.append(stored + kinetic[-1])
        stored, speed = potential(rig), later
    return np.array(kinetic), np.array(total)


def test_the_energy_of_a_bubble_that_is_let_go_never_grows(verify, energies):
    kinetic, total = energies
    lowest = np.minimum.accumulate(total)
    verify(
        "V17",
        "struck bubble, largest gain, of energy of the strike",
        (total - lowest).max() / kinetic[0],
        0.0,
        1e-6,
    )


def test_the_energy_passes_between_motion_wall_and_gas(energies):
    kinetic, total = energies
    # Else it would be no test that the sum stays: the motion alone rises again and again, by far more than it may.
    assert (kinetic - np.minimum.accumulate(kinetic)).max() > 0.05 * kinetic[0]
    assert total[0] - total[-1] < kinetic[0]


def test_a_bubble_of_true_mass_keeps_its_momentum_and_its_spin_for_a_second(verify):
    dt, substeps = 2.0e-5, 100
    rig = struck(substeps, dt)
    push, turn = rig.momentum()
    for _ in range(round(1.0 / (dt * substeps))):
        rig.advance()
    pushed, turned = rig.momentum()
    scale = rig.array("mass").sum() * WAVE_SPEED
    verify("V17", "struck bubble, momentum", np.abs(pushed - push).max() / scale, 0.0, 1e-6)
    verify(
        "V17",
        "struck bubble, angular momentum",
        np.abs(turned - turn).max() / (scale * 2.0 * STRETCH * RADIUS),
        0.0,
        1e-6,
    )
