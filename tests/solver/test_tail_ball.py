"""A tail ball of latex: stretched rubber gives way to the gas of the tube, and the flat tail beside it does not."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.tube_theory import inflated_rubber, maxwell_state, pressure_maximum
from balloon_usd.operations.tail_ball import SHORTEST, TailBall
from balloon_usd.plan import plan
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many


class Tipped:
    """The example of the operation: radii of all rings (R0), gas and pressure of the rest in every frame."""

    def __init__(self):
        self.plan = plan(Recipe.parse(TailBall.example + "physics: {hold: 2}\n"))
        self.simulation = simulate_many([self.plan], device="cpu")
        (self.mesh,) = self.simulation.meshes[0]
        self.radii, self.gas, self.pressure, self.points = [], [], [], []
        self.began = None
        for (frame,) in self.simulation.frames():
            if self.began is None and frame.doing.startswith("tail ball"):
                self.began = len(self.gas)
            rings = frame.points[0][self.mesh.ring_start[:, None] + np.arange(self.mesh.around)].astype(float)
            middle = rings.mean(axis=1, keepdims=True)
            radius = self.plan.strips["main"].size.radius
            self.radii.append(np.linalg.norm(rings - middle, axis=2).mean(axis=1) / radius)
            self.gas.append(float(self.simulation.model.scene.amount.numpy().sum()))
            self.pressure.append(float(frame.pressure[-1]))
            self.points.append(frame.points)


@pytest.fixture(scope="module")
def tipped():
    return Tipped()


def test_the_tip_is_a_ball_in_the_end_and_the_tail_beside_it_is_flat(tipped):
    before, after = tipped.radii[tipped.began - 1], tipped.radii[-1]
    assert before[-8:].max() < 1.3
    assert after[-8:].max() > 5.0
    widest = int(np.argmax(after[-8:])) + len(after) - 8
    between = after[widest - 12 : widest].min()
    assert between < 1.3


def test_it_becomes_a_ball_within_a_second_and_stays_one(tipped):
    widths = np.array([radii[-8:].max() for radii in tipped.radii])
    fps = round(tipped.plan.recipe.fps)
    assert widths[tipped.began + fps] > 5.0
    assert widths[-1] == pytest.approx(widths[-fps], rel=1e-3)


def test_the_gas_of_the_ball_comes_out_of_the_tube_which_is_softer_then(tipped):
    assert tipped.gas[-1] == pytest.approx(tipped.gas[tipped.began - 1], rel=1e-9)
    assert tipped.pressure[-1] < 0.85 * tipped.pressure[tipped.began - 1]


def test_no_wall_goes_through_another_meanwhile(tipped):
    counter = CrossingCounter(walls_of(tipped.plan, tipped.simulation.meshes[0]), 100)
    assert all(counter.count(points).count == 0 for points in tipped.points[tipped.began :: 4])


@pytest.mark.parametrize(("name", "gives_way"), [("ogden", True), ("gent", True), ("ogden-treloar", False)])
def test_stretched_rubber_gives_way_where_its_highest_pressure_is_below_that_of_the_tube(name, gives_way):
    rubber = rubber_named(name)
    highest = pressure_maximum(inflated_rubber(rubber)).p_star
    assert (highest < maxwell_state(rubber).p_star) == gives_way
    planned = plan(Recipe.parse(TailBall.example))
    assert planned.recipe.steps[-1].tail_ball["tail"] > SHORTEST * planned.strips["main"].size.radius
