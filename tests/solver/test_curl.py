"""Bubbles that hands roll up: they stay coils, with walls that touch and do not cross."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.operations.curl import KEPT, PITCH
from balloon_usd.operations.moves import Curl
from balloon_usd.plan import plan
from balloon_usd.quality.ring_corners import RingCorners
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.quality.wound import turns_of_coil
from balloon_usd.recipe import Recipe, RecipeBuilder, RecipeError
from balloon_usd.solver.latex.coil import Disc, Helix
from balloon_usd.solver.motions.curve import Row
from balloon_usd.solver.simulation import simulate_many

TUBE = """
format: 1
name: spring
units: cm
balloons:
  main: {size: 160, length: 16, tail: 5}
steps:
  - ear: {knob: 2}
"""
SPRING = TUBE + "  - rest: body\n  - curl: {body: 1.5}\n    point: up\n"
SWEET = """
format: 1
name: sweet
units: cm
balloons:
  main: {size: 160, inflated: 36}
steps:
  - bubbles: {stick: 5}
  - rest: sweet
  - curl: {sweet: 1.15}
    point: left
    disc: true
must_hold: planned
"""
CHAIN = TUBE + "  - bubbles: {feeler: 20}\n  - loop: {ring: 12}\n"


class Coiled:
    """A figure with a coil: how it lies when hands have rolled it up, and in the end."""

    def __init__(self, recipe):
        self.plan = plan(Recipe.parse(recipe))
        self.move = next(move for move in self.plan.choreography.moves if isinstance(move, Curl))
        simulation = simulate_many([self.plan], device="cpu")
        (meshes,) = simulation.meshes
        firm = self.move.rings[: len(self.move.rings) - self.move.flat]
        rings = [RingCorners.of(self.plan, meshes, ring) for ring in firm]
        quality = QualityWatch(self.plan, meshes)
        done = 1 + math.ceil(self.move.end * self.plan.recipe.fps)
        for (frame,) in simulation.frames():
            quality.add(frame)
            if frame.time_code in (done, self.plan.frame_count):
                middles = np.array([ring.places(frame).mean(axis=0) for ring in rings])
                if frame.time_code == done:
                    self.rolled = middles
                    self.tail_rolled = self._tail(meshes, frame)
        self.kept = middles
        self.quality = quality.data()

    def _tail(self, meshes, frame):
        """The last but one ring on its flat tail, and that at which it begins: their middles, m."""
        rings = self.move.rings
        ends = rings[-2], rings[len(rings) - self.move.flat - 1]
        return [RingCorners.of(self.plan, meshes, ring).places(frame).mean(axis=0) for ring in ends]


def sense(middles):
    """Return whether a coil goes on along its axis like a right-handed screw (1) or a left-handed one (-1)."""
    ways = np.diff(middles, axis=0)
    axis = np.cross(ways[:-1], ways[1:]).sum(axis=0)
    return np.sign(axis @ (middles[-1] - middles[0]))


@pytest.fixture(scope="module")
def spring():
    return Coiled(SPRING)


def test_hands_roll_a_tail_up_farther_than_the_recipe_says_into_a_round_coil(spring):
    assert spring.move.turns == pytest.approx(1.5 / KEPT)
    assert turns_of_coil(spring.rolled) == pytest.approx(spring.move.turns, rel=0.03)
    assert sense(spring.rolled) == 1.0
    upward = spring.rolled[-1, 2] - spring.rolled[0, 2]
    assert upward == pytest.approx(spring.move.rise * spring.move.turns, rel=0.05)


def test_what_the_recipe_says_stays_when_hands_let_go_and_no_wall_goes_through_another(spring):
    turns = turns_of_coil(spring.kept)
    assert turns == pytest.approx(1.5, abs=0.15)
    assert spring.quality["unwound"]["turns"] == {"body": [round(turns, 3), 1.5]}
    assert spring.quality["unwound"]["verdict"] == "good"
    assert spring.quality["crossings"]["value"] == 0
    assert spring.quality["crossings"]["most"] == 0


def test_the_tail_keeps_its_gas_and_its_flat_tip_while_it_is_rolled_up(spring):
    assert spring.quality["gas"]["verdict"] == "good"
    assert spring.quality["tail"]["verdict"] == "good"


@pytest.fixture(scope="module")
def sweet():
    return Coiled(SWEET)


def test_a_disc_lies_in_one_plane_and_grows_by_a_tube_with_each_turn(sweet):
    middle = sweet.rolled - sweet.rolled.mean(axis=0)
    assert np.abs(middle[:, 1]).max() < 0.002
    assert turns_of_coil(sweet.rolled) == pytest.approx(sweet.move.turns, rel=0.04)
    assert sweet.move.rise == 0.0
    assert sweet.move.growth == pytest.approx(PITCH * 0.026, rel=0.1)


def test_its_turns_touch_and_stay_and_no_wall_goes_through_another_without_any_fold(sweet):
    assert turns_of_coil(sweet.kept) == pytest.approx(1.15, abs=0.15)
    assert sweet.quality["crossings"]["most"] == 0


def test_the_flat_tail_comes_out_of_a_disc_along_its_axis(sweet):
    tip, inner = sweet.tail_rolled
    way = (tip - inner) / np.linalg.norm(tip - inner)
    assert way @ sweet.move.point > 0.9


@pytest.mark.long
def test_a_bubble_in_the_middle_takes_along_what_hangs_on_its_free_end_and_a_mirrored_one_is_left_handed():
    coiled = Coiled("mirror: true\n" + CHAIN + "  - curl: {feeler: 1}\n    point: left\n")
    assert sense(coiled.kept) == -1.0
    assert turns_of_coil(coiled.kept) == pytest.approx(1.0, abs=0.2)
    assert coiled.quality["crossings"]["value"] == 0


def test_turns_below_0_are_left_handed():
    recipe = Recipe.parse(SPRING.replace("1.5}", "-1.5}"))
    (move,) = (move for move in plan(recipe).choreography.moves if isinstance(move, Curl))
    assert move.turns == pytest.approx(-1.5 / KEPT)
    assert move.asked == 1.5


def row_of(sides):
    """A straight row of rings, 60 cm long, (sides + 1, 3), m."""
    return np.stack([np.linspace(0.6, 0.0, sides + 1), np.zeros(sides + 1), np.zeros(sides + 1)], axis=1)


def rolled_up(coil, row, stretched):
    """Where the rings of a row are when it is rolled up; on the way none is stretched by more than a share."""
    assert coil.places(0.0) == pytest.approx(row, abs=1e-9)
    for progress in (0.2, 0.5, 0.9, 1.0):
        places = coil.places(progress)
        assert places[-1] == pytest.approx(row[-1], abs=1e-12)
        apart = np.linalg.norm(np.diff(places, axis=0), axis=1)
        assert apart == pytest.approx(np.full(len(row) - 1, 0.6 / (len(row) - 1)), rel=stretched)
    return places


@pytest.mark.parametrize("turns", [-2.0, 3.0])
@pytest.mark.parametrize("axis", [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0)])
def test_a_row_of_rings_is_rolled_up_without_being_stretched(axis, turns):
    row = row_of(48)
    places = rolled_up(Helix(Row(row), turns, np.array(axis), 0.03), row, 0.04)
    assert turns_of_coil(places) == pytest.approx(abs(turns), rel=1e-3)
    assert sense(places[::-1]) == np.sign(turns)
    assert (places[0] - places[-1]) @ np.array(axis) == pytest.approx(0.03 * abs(turns))


@pytest.mark.parametrize("turns", [-1.5, 2.0])
@pytest.mark.parametrize("axis", [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0)])
def test_a_row_of_rings_is_rolled_up_into_a_disc_without_being_stretched(axis, turns):
    row = row_of(192)
    disc = Disc(Row(row), turns, np.array(axis), 0.03)
    rolled = rolled_up(disc, row, 0.02)
    for progress in (0.2, 0.5, 0.9, 1.0):
        places, turned = disc.places(progress), disc.turned(progress)
        outward = (places[0] - places[1]) / np.linalg.norm(places[0] - places[1])
        assert turned @ (1.0, 0.0, 0.0) == pytest.approx(outward, abs=0.1)
    assert turns_of_coil(rolled) == pytest.approx(abs(turns), rel=0.02)
    assert np.ptp(rolled @ np.array(axis)) < 1e-9
    apart = np.linalg.norm(rolled[:, None] - rolled[None, :], axis=2)
    far_along = np.abs(np.subtract.outer(np.arange(193), np.arange(193))) > 20
    assert apart[far_along].min() == pytest.approx(0.03, rel=0.05)


@pytest.mark.parametrize("turns", [-2.0, 3.0])
@pytest.mark.parametrize("axis", [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0)])
def test_what_hangs_on_the_end_that_is_rolled_in_turns_with_it(axis, turns):
    row = row_of(960)
    coil = Helix(Row(row), turns, np.array(axis), 0.03)
    assert coil.turned(0.0) == pytest.approx(np.eye(3), abs=1e-9)
    for progress in (0.2, 0.5, 0.9, 1.0):
        places, turned = coil.places(progress), coil.turned(progress)
        assert turned @ turned.T == pytest.approx(np.eye(3), abs=1e-9)
        outward = (places[0] - places[1]) / np.linalg.norm(places[0] - places[1])
        assert turned @ (1.0, 0.0, 0.0) == pytest.approx(outward, abs=0.03)


def test_flat_rubber_is_wound_as_far_as_hands_hold_it_and_its_tip_goes_straight_on():
    sides = np.array([0.05, *[0.005] * 4, *[0.02] * 20])
    row = np.zeros((26, 3))
    row[:, 0] = sides.sum() - np.concatenate([[0.0], np.cumsum(sides)])
    coil = Helix(Row(row, (5, 0)), 2.0, np.array([0.0, 0.0, 1.0]), 0.03)
    row[:5, 0] += [0.04, 0.04, 0.03, 0.02, 0.01]
    coil.measure(row)
    places = coil.places(1.0)
    apart = np.linalg.norm(np.diff(places, axis=0), axis=1)
    assert apart[0] == pytest.approx(0.05)
    assert apart[1:5] == pytest.approx(np.full(4, 0.015), rel=0.05)
    assert turns_of_coil(places[5:]) == pytest.approx(2.0, rel=0.01)


@pytest.mark.parametrize(
    ("steps", "told"),
    [
        (TUBE + "  - rest: body\n  - curl: {body: 12}\n", "12 is out of range, expected -10 to 10 turns"),
        (TUBE + "  - rest: body\n  - curl: {body: 0.2}\n", "0.2 turns are no coil, expected bend"),
        (TUBE + "  - rest: body\n  - curl: {body: -7}\n", "are too short for 7 turns, expected at most 4.4"),
        (
            CHAIN + "  - curl: {ring: 1}\n",
            "both ends of ring hang on one figure, expected a bubble with a free end",
        ),
        (CHAIN + "  - curl: {feler: 1}\n", 'unknown bubble "feler"'),
        (SPRING + "  - curl: {body: 1}\n", r"was curved at steps\[2\].curl.body, expected that once"),
        (
            SPRING + "  - bend: {body: 30}\n",
            r"was curved at steps\[2\].curl.body, expected curl or bend alone",
        ),
        (
            SPRING.replace("curl: {body: 1.5}", "bend: {body: 60}") + "  - curl: {body: 1}\n",
            "bend or curl alone",
        ),
        (SWEET.replace("1.15}", "3}"), "are too short for 3 turns, expected at most 1.4, or 111.3 cm"),
        (
            CHAIN + "  - curl: {feeler: 0.6}\n    disc: true\n",
            "something hangs on both ends, expected a free end from which a disc is rolled up",
        ),
        (SPRING + "    seconds: 0.5\n", "0.5 s are too short a time to curl body"),
    ],
)
def test_what_is_no_coil_or_has_no_length_or_no_free_end_is_refused(steps, told):
    with pytest.raises(RecipeError, match=told):
        plan(Recipe.parse(steps))


def test_turns_may_be_numbers_of_numpy():
    for turns in (np.float32(1.5), np.int64(1), np.float64(1.5)):
        builder = RecipeBuilder("spring").balloon("main", size=160, length=0.16, tail=0.05)
        recipe = builder.ear(knob=0.02).rest("body").curl(body=turns).build()
        assert recipe.steps[2].curl == {"body": float(turns)}


def test_a_coil_as_tight_as_can_be_is_told_to_open():
    tight = plan(Recipe.parse(SPRING.replace("1.5}", "4.2}")))
    assert any("opens to fewer than 4.2 turns" in str(caution) for caution in tight.cautions)
    assert not plan(Recipe.parse(SPRING)).cautions


def test_walls_of_neighbouring_turns_lie_apart():
    assert PITCH > 1.0
