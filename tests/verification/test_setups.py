"""The general set-ups enclose the gas that they should, and stand still unless something moves them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.tube_theory import fixed_length_tube_pressure
from tests.verification.setups import (
    Rig,
    cube_sphere,
    plain,
    plate,
    polygon_factor,
    revolved,
    ring_stretches,
    stretched,
    tube,
)

RADIUS, THICKNESS, AROUND = 4.5e-3, 0.18e-3, 16
LATEX = plain(rubber_named())
STATIONS = 0.3 * RADIUS * np.arange(11.0)
GAS = math.pi * RADIUS**2 * STATIONS[-1] * polygon_factor(AROUND)
"""Gas in the whole tube, m3."""


SET_UPS = {
    "closed tube": (tube(RADIUS, AROUND, STATIONS, parts=()), [GAS]),
    "two chambers": (tube(RADIUS, AROUND, STATIONS, parts=(3,)), [0.3 * GAS, 0.7 * GAS]),
    "open tube": (tube(RADIUS, AROUND, STATIONS), [0.0, GAS, 0.0]),
    "double cone": (
        revolved(RADIUS * np.array([0.2, 1.0, 0.2]), AROUND, RADIUS * np.array([0.0, 0.8, 1.6])),
        [math.pi * RADIUS**3 * 1.6 * (0.04 + 0.2 + 1.0) / 3.0 * polygon_factor(AROUND)],
    ),
    "plate": (plate(3, 3, RADIUS), [0.0]),
}
"""Mesh, and the gas in every chamber, m3: set-ups whose quads are flat."""


@pytest.mark.parametrize("name", SET_UPS)
def test_every_set_up_encloses_its_gas_and_is_at_rest_without_pressure(name):
    mesh, gas = SET_UPS[name]
    rig = Rig(mesh, LATEX, THICKNESS, gauge=(0.0,) * len(gas), vented=tuple(range(len(gas))))
    assert rig.array("volume") / GAS == pytest.approx(np.array(gas) / GAS, rel=1e-4, abs=1e-6)
    rig.advance()
    assert np.abs(rig.points - mesh.points).max() < 1e-5 * RADIUS


@pytest.mark.parametrize(("cells", "missing"), [(8, 1.67e-2), (16, 4.2e-3)])
def test_a_sphere_of_quads_lacks_a_share_of_its_gas_that_falls_with_the_square_of_its_cells(cells, missing):
    rig = Rig(cube_sphere(RADIUS, cells), LATEX, THICKNESS)
    share = rig.array("volume")[0] / (4.0 / 3.0 * math.pi * RADIUS**3)
    assert 1.0 - share == pytest.approx(missing, rel=2e-2)


def test_a_tube_whose_length_is_held_is_a_piece_of_an_endless_one():
    mesh = tube(RADIUS, AROUND, STATIONS[:4])
    rig = Rig(mesh, LATEX, THICKNESS, gauge=(0.0, 7.0e3, 0.0), vented=(0, 1, 2))
    rig.place(stretched(mesh, 1.2, 1.1))
    rig.hold_length()
    rig.settle()
    hoop, axial = ring_stretches(rig)
    # Its ends are as wide as its middle: nothing tells them from the rest.
    assert np.ptp(hoop) < 1e-4
    assert axial == pytest.approx(1.1, rel=1e-4)
    theory = fixed_length_tube_pressure(LATEX, hoop.mean(), 1.1) * THICKNESS / RADIUS
    assert theory == pytest.approx(7.0e3, rel=2e-3)
