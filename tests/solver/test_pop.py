"""A popped bubble of latex: its gas is gone, its neighbours keep theirs, and its rubber is flat again."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.ringed_faces import polygon_share
from balloon_usd.operations.pop import Pop
from balloon_usd.plan import plan
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.simulation import simulate_many

NAMES = ("before", "first", "gap", "second", "beyond")


class Popped:
    """The example of the operation, with the gas of all bubbles and the place of their joints in each frame."""

    def __init__(self, text):
        self.plan = plan(Recipe.parse(text))
        self.simulation = simulate_many([self.plan], device="cpu")
        self.at = [bubble.name for bubble in self.plan.bubbles].index("gap")
        model = self.simulation.model
        self.gas, self.pressure, self.volume, self.apart, self.points = [], [], [], [], []
        self.began = None
        for (frame,) in self.simulation.frames():
            if self.began is None and frame.doing.startswith("pop"):
                self.began = len(self.gas)
            self.gas.append(model.scene.amount.numpy()[model.layout.bubbles])
            self.pressure.append(float(frame.pressure[self.at]))
            self.volume.append(float(frame.volume[self.at]))
            self.points.append(frame.points[0].copy())
            ends = [model.performers[0].sculpture.joints[ring] for ring in self.plan.table.ends("gap")]
            middle = model.scene.ring_middle.numpy()[ends]
            self.apart.append(float(np.linalg.norm(middle[1] - middle[0])))

    @property
    def shut(self):
        """Number of the last frame before the pop."""
        return self.began - 1


@pytest.fixture(scope="module")
def popped():
    return Popped(Pop.example + "physics: {hold: 0.5}\n")


def test_the_gas_of_a_popped_bubble_is_gone_within_an_eighth_of_a_second(popped):
    assert popped.pressure[popped.shut] > 7.0e3
    # It begins and ends between frames.
    assert popped.pressure[popped.shut + 4] == 0.0
    assert popped.gas[-1][popped.at] == 0.0


def test_its_neighbours_keep_all_of_theirs(popped):
    others = [k for k in range(len(NAMES)) if k != popped.at]
    assert popped.gas[-1][others] == pytest.approx(popped.gas[popped.shut][others], rel=1e-6)


def test_its_rubber_is_as_short_and_as_thin_as_when_it_was_flat(popped):
    strip = popped.plan.strips["main"]
    bubble = next(each for each in strip.bubbles if each.name == "gap")
    around = popped.simulation.meshes[0][0].around
    flat = np.pi * strip.size.radius**2 * bubble.rest_length * polygon_share(around)
    assert popped.apart[popped.shut] == pytest.approx(bubble.length, rel=0.1)
    assert popped.apart[-1] < 1.3 * bubble.rest_length
    assert popped.volume[-1] < 1.5 * flat < 0.05 * popped.volume[popped.shut]


def test_what_hangs_on_it_jumps_and_comes_to_rest(popped):
    ways = [np.abs(now - before).max() for before, now in zip(popped.points, popped.points[1:], strict=False)]
    fps = popped.plan.recipe.fps
    assert max(ways[popped.shut : popped.shut + 12]) * fps > 0.3
    assert ways[-1] * fps < 2.0e-3


def test_no_wall_goes_through_another_and_no_vertex_is_lost(popped):
    counter = CrossingCounter(walls_of(popped.plan, popped.simulation.meshes[0]), 1)
    for points in popped.points[popped.shut :: 6]:
        assert counter.count((points,)).count == 0
    assert {len(points) for points in popped.points} == {len(popped.points[0])}


def test_the_rest_of_a_balloon_can_be_popped_and_hangs_limp():
    text = Pop.example.replace("pop: gap", "pop: beyond") + "physics: {hold: 0.5}\n"
    planned = plan(Recipe.parse(text))
    simulation = simulate_many([planned], device="cpu")
    for (frame,) in simulation.frames():
        last = frame
    assert last.pressure[4] == 0.0
    assert last.pressure[2] == pytest.approx(7.5e3, rel=0.05)
    assert last.volume[4] < 0.05 * planned.bubbles[4].volume


@pytest.mark.parametrize(
    ("steps", "popped"),
    [
        ("[{bubbles: {a: 4}}, {ear: {e: 3}}, {pop: a}]", "a"),
        ("[{bubbles: {a: 5}}, {loop: {l: 16}}, {pop: l}]", "l"),
    ],
)
def test_limp_rubber_may_turn_inside_out(steps, popped):
    text = f"format: 1\nname: p\nunits: cm\nballoons: {{main: {{size: 260, length: 17, tail: 6}}}}\nsteps: {steps}\n"
    planned = plan(Recipe.parse(text + "physics: {hold: 0.5}\n"))
    for (frame,) in simulate_many([planned], device="cpu").frames():
        last = frame
    assert isinstance(last, Frame)
    assert last.time_code == planned.frame_count
    assert last.pressure[[bubble.name for bubble in planned.bubbles].index(popped)] == 0.0
