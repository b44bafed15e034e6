"""V22: a pump blows up a 260 at the pressure at which its front moves."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.air import ATMOSPHERE, GAS_CONSTANT, ROOM_TEMPERATURE
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import gauge_pressure, maxwell_state
from balloon_usd.plan import plan
from balloon_usd.plan.lungs import opening_pressure
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many
from tests.verification.setups import Rig, plain, polygon_factor, ring_stretches, tube

SIZE, LATEX = size_named("260"), plain(rubber_named())
STATE = maxwell_state(LATEX)
PRESSURE = gauge_pressure(SIZE, STATE.p_star)
AROUND, CELL, CELLS = 12, 0.5 * SIZE.radius, 40
FLOW = 50.0e-6
"""What the pump delivers, m3/s of gas at the balloon's pressure."""
PUMPED, EARLY = 1.5, 0.4
"""Time for which it is pumped, and when the front has taken up its steady motion, s."""


def two_phases(mesh, front):
    """Points of a tube that is bulged as far as `front` (m) and thin beyond, (V, 3), m."""
    fine = np.linspace(0.0, mesh.points[:, 0].max(), 2001)

    def bulged(place):
        return 0.5 * (1.0 - np.tanh((place - front) / (1.2 * SIZE.radius)))

    axial = STATE.thin.b + (STATE.bulged.b - STATE.thin.b) * bulged(fine)
    along = np.concatenate([[0.0], np.cumsum(0.5 * (axial[1:] + axial[:-1]) * np.diff(fine))])
    hoop = STATE.thin.a + (STATE.bulged.a - STATE.thin.a) * bulged(mesh.points[:, 0])
    return np.column_stack([np.interp(mesh.points[:, 0], fine, along), hoop[:, None] * mesh.points[:, 1:]])


def front(rig):
    """Unstressed place at which the hoop stretch is midway between both phases, m."""
    hoop, _ = ring_stretches(rig)
    midway = 0.5 * (STATE.thin.a + STATE.bulged.a)
    last = int(np.flatnonzero(hoop > midway)[-1])
    return (last + (hoop[last] - midway) / (hoop[last] - hoop[last + 1])) * CELL


@pytest.fixture(scope="module")
def pumped():
    """Time (s), front (m), gas (m3), pressure (Pa) and length (m) of a tube that is pumped up, (5, N)."""
    mesh = tube(SIZE.radius, AROUND, CELL * np.arange(CELLS + 1.0))
    rig = Rig(mesh, LATEX, SIZE.thickness, gauge=(0.0, PRESSURE, 0.0), vented=(0, 2), substeps=100)
    rig.place(two_phases(mesh, 0.35 * CELL * CELLS))
    rig.fill(1, PRESSURE)
    rig.settle(1e-4, most=1500)
    factor = polygon_factor(AROUND)
    rig.hands.pump_flow[:] = FLOW * factor * (PRESSURE + ATMOSPHERE) / (GAS_CONSTANT * ROOM_TEMPERATURE)
    rig.hands.pump_limit[:], rig.hands.pump_goal[:] = 1.0e3 * PRESSURE, np.inf
    frame = rig.stepper.substeps * rig.scene.settings.dt
    rows = []
    for k in range(1, round(PUMPED / frame) + 1):
        rig.advance()
        gas, pressure = rig.array("volume")[1] / factor, rig.array("pressure")[1]
        rows.append((k * frame, front(rig), gas, pressure, np.ptp(rig.points[:, 0])))
    return np.array([row for row in rows if row[0] > EARLY]).T


def slope(x, y):
    """Slope of the straight line through points."""
    return np.polynomial.Polynomial.fit(x, y, 1).convert().coef[1]


def test_the_pressure_stays_where_it_is_while_a_balloon_is_pumped_up(verify, pumped):
    for name, pressure in (("lowest", pumped[3].min()), ("highest", pumped[3].max())):
        verify("V22", f"260 pumped up, {name} pressure, Pa", pressure, PRESSURE, 2e-2)


def test_gas_moves_the_front_by_the_difference_of_both_phases(verify, pumped):
    _, place, gas, _, _ = pumped
    verify("V22", "260 pumped up, gas for each mm of tube, mL", slope(place, gas) * 1e3, 8.379, 2e-2)


def test_a_steady_pump_moves_the_front_and_lengthens_the_tube_steadily(verify, pumped):
    time, place, _, _, length = pumped
    verify("V22", "50 mL/s, rubber that bulges, mm/s", slope(time, place) * 1e3, 5.97, 2e-2)
    # The new bulged tube is 24.7 mm/s; what it was before, thin and a little stretched, is gone.
    thin = STATE.thin.b * slope(time, place)
    verify("V22", "50 mL/s, new bulged length, mm/s", (slope(time, length) + thin) * 1e3, 24.7, 2e-2)


LYING = """
format: 1
name: blown_up
units: cm
balloons:
  one: {{size: {size}, length: 14, tail: 6}}
steps:
  - {{rest: tube, balloon: one}}
"""


@pytest.fixture(scope="module")
def hardest():
    """Highest gauge pressure of tubes of four sizes while they are blown up, and what the plan told, Pa."""
    plans = [plan(Recipe.parse(LYING.format(size=size))) for size in ("160", "260", "350", "646")]
    simulation = simulate_many(plans, device="cpu")
    ends = [p.choreography.moves[0].end * p.recipe.fps for p in plans]
    highest = np.zeros(len(plans))
    for frames in simulation.frames():
        blown = [
            frame.pressure[0] if frame.time_code <= end else 0.0
            for frame, end in zip(frames, ends, strict=True)
        ]
        highest = np.maximum(highest, blown)
    return {
        strip.size.name: (pressure, opening_pressure(strip.size, strip.rubber, stretched=True))
        for strip, pressure in zip((p.strips["one"] for p in plans), highest, strict=True)
    }


@pytest.mark.parametrize("size", ["160", "260", "350", "646"])
def test_a_tube_whose_start_hands_stretched_begins_at_the_pressure_of_the_plan(verify, hardest, size):
    highest, told = hardest[size]
    verify("V22", f"{size} with a stretched start, highest pressure, Pa", highest, told, 2e-2)
