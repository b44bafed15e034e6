"""V01: the wall's stress against the rubber law, on a plate that is stretched evenly."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.rubber import rubber_named
from tests.verification.lone_kernels import quad_forces
from tests.verification.setups import Rig, plain, plate

SIZE, THICKNESS = 0.01, 0.18e-3
LATEX = plain(rubber_named("ogden"))
TABLE = {
    "uniaxial": {2: 0.603, 4: 1.414, 6: 3.816},
    "equibiaxial": {2: 0.817, 4: 2.089, 6: 5.952},
    "pure shear": {2: 0.684, 4: 1.481, 6: 3.887},
}
"""Nominal stress of K&C latex, MPa."""
ACROSS = {"uniaxial": lambda a: a**-0.5, "equibiaxial": lambda a: a, "pure shear": lambda a: 1.0}


def nominal_stress(mesh, rubber, points):
    """Force that pulls the plate's far edge, per unstressed cross-section, Pa."""
    rig = Rig(mesh, rubber, THICKNESS, vented=(0,))
    rig.place(points)
    rig.stepper._launch(quad_forces, len(mesh.quads))
    force = np.zeros_like(points)
    np.add.at(force, mesh.quads.ravel(), rig.array("corner_force").reshape(-1, 3))
    edge = mesh.points[:, 0] > SIZE - 1e-9
    return -force[edge, 0].sum() / (SIZE * THICKNESS)


@pytest.mark.parametrize("stretch", [2, 4, 6])
@pytest.mark.parametrize("test", list(TABLE))
def test_nominal_stress_of_an_evenly_stretched_plate_follows_the_law(verify, test, stretch):
    mesh = plate(4, 3, SIZE, distortion=0.25)
    across = ACROSS[test](float(stretch))
    measured = nominal_stress(mesh, LATEX, mesh.points * [stretch, across, 1.0])
    theory = float(LATEX.nominal_stress(float(stretch), across)[0])
    verify("V01", f"{test}, stretch {stretch}, nominal stress, Pa", measured, theory, 1e-3)
    assert measured / 1e6 == pytest.approx(TABLE[test][stretch], abs=6e-4)


@pytest.mark.parametrize("name", ["gent", "mooney-rivlin", "neo-hooke", "ogden-treloar"])
def test_every_rubber_pulls_as_its_law_says(verify, name):
    rubber, mesh = plain(rubber_named(name)), plate(3, 3, SIZE)
    measured = nominal_stress(mesh, rubber, mesh.points * [3.0, 2.0, 1.0])
    verify("V01", f"{name}, stretches 3 and 2, Pa", measured, rubber.nominal_stress(3.0, 2.0)[0], 1e-3)


def test_a_plate_that_is_pushed_together_wrinkles_and_does_not_push_back(verify):
    mesh = plate(3, 3, SIZE)
    measured = nominal_stress(mesh, LATEX, mesh.points * [0.6, 2.0, 1.0])
    verify("V01", "pushed to 0.6 across a stretch of 2, Pa", measured, 0.0, 1.0)


def test_rubber_that_was_stretched_is_softer_on_the_way_back(verify):
    rubber, mesh = rubber_named("ogden"), plate(3, 3, SIZE)
    rig = Rig(mesh, rubber, THICKNESS, vented=(0,))
    for stretch in (5.0, 4.0):
        rig.place(mesh.points * [stretch, stretch, 1.0])
        rig.stepper._launch(quad_forces, len(mesh.quads))
    force = np.zeros((len(mesh.points), 3))
    np.add.at(force, mesh.quads.ravel(), rig.array("corner_force").reshape(-1, 3))
    measured = -force[mesh.points[:, 0] > SIZE - 1e-9, 0].sum() / (SIZE * THICKNESS)
    factor = rubber.softening_factor(rubber.energy(4.0, 4.0), rubber.energy(5.0, 5.0))
    theory = float(factor * rubber.nominal_stress(4.0, 4.0)[0])
    verify("V01", "softened, back from 5 to 4 equibiaxial, Pa", measured, theory, 1e-3)
