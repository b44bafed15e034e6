"""V08: part of a sealed bubble is pressed flat, and its gas stretches the rest of the wall."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import gauge_pressure, maxwell_state
from tests.verification.setups import Rig, plain, ring_stretches, stretched, tube

SIZE, LATEX, AROUND = size_named("260"), plain(rubber_named()), 12
STATE = maxwell_state(LATEX)
PRESSURE = gauge_pressure(SIZE, STATE.p_star)
CELL = 0.3 * SIZE.radius


@cache
def sealed(cells, gas_cells):
    """Settle a closed tube of some cells with the gas of a bulged tube of others; return its pressure, Pa."""
    mesh = tube(SIZE.radius, AROUND, CELL * np.arange(cells + 1.0))
    rig = Rig(mesh, LATEX, SIZE.thickness, gauge=(0.0, PRESSURE, 0.0), vented=(0, 2))
    rig.place(stretched(mesh, STATE.bulged.a, STATE.bulged.b))
    rig.fill(1, PRESSURE)
    amount = rig.array("amount")
    amount[1] *= gas_cells / cells
    rig.scene.amount.assign(amount)
    rig.settle(most=2000)
    hoop, _ = ring_stretches(rig)
    assert np.ptp(hoop) < 1e-2, f"not even: {hoop}"
    return float(rig.array("pressure")[1])


@pytest.mark.parametrize(("blocked", "rise"), [(1, 181.0), (2, 412.0), (3, 711.0)])
def test_blocking_part_of_a_sealed_tube_raises_its_pressure_by_what_the_wall_lets(verify, blocked, rise):
    before, after = sealed(10, 10), sealed(10 - blocked, 10)
    verify("V08", f"260 with {blocked * 10} % blocked, pressure, Pa", after, PRESSURE + rise, 2e-2)
    verify("V08", f"260 with {blocked * 10} % blocked, rise of pressure, Pa", after - before, rise, 2e-2)
