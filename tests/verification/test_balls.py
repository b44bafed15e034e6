"""V29: balls, the bubbles too short to keep their gas by themselves, twisted off a balloon beside the knot and
behind a long bubble.
"""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.air import ATMOSPHERE, GAS_CONSTANT, ROOM_TEMPERATURE
from balloon_usd.balloon.bubble_shape import bubble_of_length
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import gauge_pressure, maxwell_state
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.run_summary import RunSummary
from balloon_usd.solver.simulation import simulate_many
from tests.verification.setups import polygon_factor

SIZE, LATEX = size_named("260"), rubber_named()
TUBE = gauge_pressure(SIZE, maxwell_state(LATEX).p_star)
MICROMOLES = 1e6 / (GAS_CONSTANT * ROOM_TEMPERATURE)
"""In a joule of pressure times volume."""
LENGTHS = (10, 12, 15, 18, 20, 25)
"""Of balls, mm."""
BALLS = ("nose", "ball", "next")
RECIPE = """
format: 1
name: balls
units: cm
balloons:
  main: {size: 260, length: 13, tail: 6, color: red}
steps:
  - bubbles: {nose: LENGTH, long: 4, ball: LENGTH, next: LENGTH}
  - rest: tail
  - wait: 0.5
physics: {hold: 0}
"""


@pytest.fixture(scope="module")
def made():
    """The plan, the mesh, the last frame in which nothing comes undone and the summary of every length, mm."""
    plans = [plan(Recipe.parse(RECIPE.replace("LENGTH", f"{length / 10:g}"))) for length in LENGTHS]
    simulation = simulate_many(plans, detail="draft", device="cpu")
    summaries = [RunSummary(*both) for both in zip(plans, simulation.meshes, strict=True)]
    last = {}
    for frames in simulation.frames():
        for length, frame, summary in zip(LENGTHS, frames, summaries, strict=True):
            if frame is not None and not frame.doing.startswith("comes undone"):
                summary.add(frame)
                last[length] = frame
    meshes = [meshes[0] for meshes in simulation.meshes]
    return {
        length: (planned, mesh, last[length], summary)
        for length, planned, mesh, summary in zip(LENGTHS, plans, meshes, summaries, strict=True)
    }


def rings_of(made, bubble):
    """Vertices of the rings of a bubble, (rings, around, 3), m."""
    planned, mesh, frame, _ = made
    own = next(each for each in planned.bubbles if each.name == bubble)
    rows = np.arange(mesh.ring_at(own.rest_start), mesh.ring_at(own.rest_end) + 1)
    return frame.points[0][mesh.ring_start[rows][:, None] + np.arange(mesh.around)].astype(float)


@pytest.mark.parametrize("bubble", BALLS)
@pytest.mark.parametrize("length", LENGTHS)
def test_a_ball_has_the_gas_the_pressure_and_the_shape_of_theory(verify, made, length, bubble):
    planned, mesh, frame, _ = made[length]
    theory = bubble_of_length(SIZE, LATEX, length * 1e-3)
    at = [each.name for each in planned.bubbles].index(bubble)
    volume = frame.volume[at] / polygon_factor(mesh.around)
    pressure = theory.pressure * TUBE
    gas = (ATMOSPHERE + frame.pressure[at]) * volume
    rings = rings_of(made[length], bubble)
    middle = rings.mean(axis=1)
    girth = np.linalg.norm(rings - np.roll(rings, 1, axis=1), axis=2).sum(axis=1).max()
    diameter = girth / (mesh.around * np.tan(np.pi / mesh.around))
    name = f"{bubble} of {length} mm"
    wanted = (ATMOSPHERE + pressure) * theory.volume
    verify("V29", f"{name}, gas, umol", gas * MICROMOLES, wanted * MICROMOLES, 1e-2)
    verify("V29", f"{name}, pressure, kPa", frame.pressure[at] / 1e3, pressure / 1e3, 7e-2)
    apart = float(np.linalg.norm(middle[-1] - middle[0]))
    verify("V29", f"{name}, length, mm", apart * 1e3, length, 7e-2)
    verify("V29", f"{name}, diameter, mm", diameter * 1e3, theory.diameter * 1e3, 7e-2)


@pytest.mark.parametrize("length", LENGTHS)
def test_no_gas_is_told_to_be_off_the_plan(made, length):
    assert made[length][-1].gas_off == {}
