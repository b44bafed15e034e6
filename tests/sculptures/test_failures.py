"""What goes wrong for makers goes wrong here, and for the reasons that they give."""

from __future__ import annotations

import pytest

from balloon_usd.plan import plan
from balloon_usd.quality.passed import PassedBubbles
from balloon_usd.recipe import Recipe
from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.simulation import simulate_many

BALLS = """
format: 1
name: balls
units: cm
balloons:
  main: {{size: 260, length: 12, tail: {tail}}}
steps:
  - repeat: {{k: 7}}
    steps:
      - bubbles: {{ball_<k>: 3}}
physics: {{burst: stop, hold: 0.2}}
"""
BIRD = """
format: 1
name: bird
units: cm
balloons:
  main: {{size: 260, length: 26, tail: 8}}
steps:
  - bubbles: {{left: 9, right: 9}}
  - lock: [left, right]
  - bubbles: {{belly: {belly}}}
  - roll: {{bubble: belly, between: [left, right]}}
"""


def run(text):
    """Return all frames of a recipe, the failure last if it fails, and whether its bubbles stay in rings."""
    planned = plan(Recipe.parse(text))
    simulation = simulate_many([planned], device="cpu")
    passed = PassedBubbles(planned, simulation.meshes[0])
    found = []
    for (frame,) in simulation.frames():
        found.append(frame)
        if not isinstance(frame, SimulationFailed):
            passed.add(frame)
    return found, passed


@pytest.fixture(scope="module")
def taut():
    return run(BALLS.format(tail=0.2))[0]


@pytest.fixture(scope="module")
def roomy():
    return run(BALLS.format(tail=7))[0]


def test_a_balloon_without_a_tail_bursts_while_it_is_twisted_and_one_with_a_tail_does_not(taut, roomy):
    assert isinstance(taut[-1], SimulationFailed)
    assert "main_rest bursts" in taut[-1].cause
    assert not isinstance(roomy[-1], SimulationFailed)


def test_what_is_left_is_rock_hard_where_the_tail_has_run_out(taut, roomy):
    twisted = len(taut) - 2
    assert taut[twisted].pressure[-1] > 8500.0
    assert roomy[twisted].pressure[-1] < 7900.0


@pytest.mark.parametrize(("belly", "stays"), [(9, True), (3, False)])
def test_the_body_of_a_bird_slips_apart_where_its_bubbles_are_unequal(belly, stays):
    _, passed = run(BIRD.format(belly=belly))
    assert (not passed.stuck() and not passed.slipped()) == stays
