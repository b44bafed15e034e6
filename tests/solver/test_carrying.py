"""What hangs on a joint that hands move is carried, also where it is of another balloon."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from balloon_usd.operations.moves import Bring, Gather, LeadIn, Pinch
from balloon_usd.plan import plan as plan_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import Simulation, simulate_many

HANGING = """
format: 1
name: hanging
units: cm
fps: 8
balloons:
  red: {size: 260, length: 12, tail: 4}
  blue: {size: 260, length: 12, tail: 4}
steps:
  - {bubbles: {nose: 4, left: 6, right: 6}, balloon: red}
  - {bubbles: {arm: 4}, balloon: blue}
  - lock: {joints: [nose.end, arm.end]}
  - {lock: [left, right], point: up}
  - {rest: red_rest, balloon: red}
  - {rest: blue_rest, balloon: blue}
physics: {hold: 0.1}
"""
UNEQUAL = """
format: 1
name: unequal
units: cm
fps: 8
balloons:
  red: {size: 260, length: 20, tail: 3}
  blue: {size: 260, length: 8, tail: 3}
steps:
  - wait: 0.2
physics: {hold: 0.1}
"""


@dataclass
class Performed:
    """A sculpture of several balloons, frame by frame."""

    simulation: Simulation
    frames: list

    def moved(self, kind, name):
        """How far a ring goes while the first move of a kind is performed, m."""
        first, last = self.during(kind)
        return self.place(last, name) - self.place(first, name)

    def during(self, kind):
        """Frames in which the first move of a kind begins and ends."""
        plan = self.simulation.plans[0]
        move = next(move for move in plan.choreography.moves if isinstance(move, kind))
        return tuple(round(time * plan.recipe.fps) for time in (move.start, move.end))

    def place(self, frame, name):
        plan, meshes = self.simulation.plans[0], self.simulation.meshes[0]
        ring = next(ring for ring in plan.table.rings if ring.name == name)
        balloon = list(plan.strips).index(ring.balloon)
        first = meshes[balloon].ring_start[meshes[balloon].ring_at(ring.along)]
        points = self.frames[frame].points[balloon]
        return points[first : first + meshes[balloon].around].mean(axis=0, dtype=float)


def perform(recipe):
    simulation = simulate_many([plan_of(Recipe.parse(recipe))], device="cpu")
    return Performed(simulation, [outcomes[0] for outcomes in simulation.frames()])


@pytest.fixture(scope="module")
def hanging():
    """A balloon that is welded to the moving end of two bubbles which are then folded."""
    return perform(HANGING)


@pytest.mark.parametrize("name", ["blue.knot", "blue_rest.0", "blue_rest.1"])
def test_a_balloon_on_the_moving_end_of_a_chain_goes_along(hanging, name):
    joint = hanging.moved(Gather, "nose.end")
    assert np.linalg.norm(joint) > 0.1
    assert hanging.moved(Gather, name) == pytest.approx(joint, abs=0.02)


@pytest.mark.parametrize("name", ["blue.knot", "blue_rest.0"])
def test_a_balloon_follows_its_joint_that_is_brought_to_another(hanging, name):
    joint, moved = hanging.moved(Bring, "arm.end"), hanging.moved(Bring, name)
    assert joint[1] < -0.1
    assert moved[1] < 0.5 * joint[1]


def test_a_balloon_keeps_still_until_it_is_led_in_and_the_figure_while_it_comes(hanging):
    first, last = hanging.during(Pinch)[1], hanging.during(LeadIn)[0]
    for name in ("blue.knot", "blue_rest.1"):
        aside = hanging.place(last, name)[1:]
        assert aside == pytest.approx(hanging.place(first, name)[1:], abs=1e-3)
    assert hanging.moved(LeadIn, "arm.end")[1] == pytest.approx(-0.24, abs=0.01)
    for name in ("red.knot", "nose.end", "red_rest.1"):
        assert hanging.moved(LeadIn, name) == pytest.approx(np.zeros(3), abs=2e-3)


def test_balloons_of_different_lengths_are_blown_up_each_in_its_own_time():
    performed = perform(UNEQUAL)
    assert len(performed.frames) == performed.simulation.plans[0].frame_count
    assert all(volume > 0.0 for volume in performed.frames[-1].volume)
