"""V07 and V24: a whole balloon, blown up with a tail and twisted."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.tube_theory import gauge_pressure, maxwell_state
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

TUBE = """
format: 1
name: tube
units: cm
balloons:
  main: {size: 260, length: 20, tail: 9, color: red}
steps:
  - bubbles: {first: 7, second: 7}
  - rest: tail
physics: {softening: false, hold: 0.2}
"""


def at_move(text, recipe=TUBE, detail="draft"):
    """Perform a recipe until the hands do something; return the simulation and its frame."""
    made = plan(Recipe.parse(recipe))
    simulation = simulate_many([made], detail=detail, device="cpu")
    frame = None
    for frames in simulation.frames():
        if frames[0].doing.startswith(text):
            return simulation, frame
        frame = frames[0]
    raise AssertionError(f"the hands never {text}")


@pytest.fixture(scope="module")
def blown_up():
    return at_move("pinch")


def stretches(simulation, frame):
    """Hoop stretch of every ring and axial stretch between rings of the only balloon."""
    mesh, size = simulation.meshes[0][0], next(iter(simulation.plans[0].strips.values())).size
    rings = frame.points[0][mesh.ring_start[:, None] + np.arange(mesh.around)].astype(float)
    girth = np.linalg.norm(rings - np.roll(rings, 1, axis=1), axis=2).sum(axis=1)
    middle = rings.mean(axis=1)
    hoop = girth / (2.0 * mesh.around * np.tan(np.pi / mesh.around) * size.radius)
    axial = np.linalg.norm(np.diff(middle, axis=0), axis=1) / np.diff(mesh.ring_along)
    return mesh.ring_along, hoop, axial


def test_a_latex_tube_with_a_tail_stands_at_its_maxwell_pressure(verify, blown_up):
    simulation, frame = blown_up
    strip = simulation.plans[0].strips["main"]
    theory = gauge_pressure(strip.size, maxwell_state(strip.rubber).p_star)
    assert theory == pytest.approx(7134.5, rel=1e-3)
    verify("V07", "260 with a tail, pressure, Pa", frame.pressure[0], theory, 2e-2)


def test_the_bulged_part_and_the_tail_have_the_two_stretches_of_the_maxwell_state(verify, blown_up):
    simulation, frame = blown_up
    state = maxwell_state(simulation.plans[0].strips["main"].rubber)
    along, hoop, axial = stretches(simulation, frame)
    bulged = (along > 0.06) & (along < 0.08)
    verify("V07", "bulged phase, hoop stretch", hoop[bulged].mean(), state.bulged.a, 1e-2)
    verify("V07", "bulged phase, axial stretch", axial[bulged[:-1]].mean(), state.bulged.b, 1e-2)
    thin = (along > 0.15) & (along < 0.175)
    verify("V07", "thin phase, hoop stretch", hoop[thin].mean(), state.thin.a, 1e-2)
    verify("V07", "thin phase, axial stretch", axial[thin[:-1]].mean(), state.thin.b, 1e-2)


def test_gas_is_shared_by_a_pinch_and_then_stays_where_it_is(verify):
    made = plan(Recipe.parse(TUBE.replace("softening: false, ", "")))
    simulation = simulate_many([made], detail="draft", device="cpu")
    total, sealed = [], []
    for frames in simulation.frames():
        amount = simulation.model.scene.amount.numpy()[2:]
        if frames[0].doing.startswith(("pinch", "twist", "hold")):
            total.append(amount.sum())
        if frames[0].doing.startswith(("twist: second", "hold")):
            sealed.append(amount.copy())
    verify("V24", "all gas, change over two pinches", np.ptp(total) / total[0], 0.0, 1e-6)
    drift = np.ptp(np.array(sealed), axis=0) / sealed[0]
    verify("V24", "gas of each sealed bubble, change", drift.max(), 0.0, 1e-6)
