"""Bubbles that hands wind round each other: they stay so, without a twist of their own walls."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.operations.moves import WindRound
from balloon_usd.operations.spiral import SPRING_BACK, tightest_turn, wound_radius
from balloon_usd.plan import plan
from balloon_usd.quality.ring_corners import RingCorners
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.quality.wound import turns_of
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.solver.latex.motions.wind_round import twist_of
from balloon_usd.solver.simulation import simulate_many

PAIR = """
format: 1
name: rope
units: cm
balloons:
  main: {size: 260, length: 66, tail: 6}
steps:
  - bubbles: {grip: 4, one: 29, other: 29}
  - lock: [one, other]
    point: up
"""


class Wound:
    """A figure with a spiral: how its strands lie when they are wound, and in the end."""

    def __init__(self, recipe):
        self.plan = plan(Recipe.parse(recipe))
        move = next(move for move in self.plan.choreography.moves if isinstance(move, WindRound))
        simulation = simulate_many([self.plan], device="cpu")
        (meshes,) = simulation.meshes
        rings = [[RingCorners.of(self.plan, meshes, ring) for ring in strand] for strand in move.strands]
        quality = QualityWatch(self.plan, meshes)
        done = 1 + math.ceil(move.end * self.plan.recipe.fps)
        for (frame,) in simulation.frames():
            quality.add(frame)
            if frame.time_code in (done, self.plan.frame_count):
                corners = [np.array([ring.places(frame) for ring in strand]) for strand in rings]
                middles = [places.mean(axis=1) for places in corners]
                if frame.time_code == done:
                    self.wound = turns_of(middles)
                    self.twisted = [
                        twist_of(middle[1:-1], corner[1:-1, 0]) / math.tau
                        for middle, corner in zip(middles, corners, strict=True)
                    ]
        self.turns = turns_of(middles)
        self.quality = quality.data()


@pytest.fixture(scope="module")
def pair():
    return Wound(PAIR + "  - spiral: {bubbles: [one, other], turns: 1}\n")


def test_a_pair_is_wound_farther_than_the_recipe_says_like_a_right_handed_screw(pair):
    (move,) = (move for move in pair.plan.choreography.moves if isinstance(move, WindRound))
    assert move.asked == 1.0
    assert 1.0 < move.turns < 1.0 + SPRING_BACK
    assert pair.wound == pytest.approx(move.turns, abs=0.15)


def test_winding_does_not_twist_the_walls_themselves(pair):
    assert max(map(abs, pair.twisted)) < 0.1


def test_what_the_recipe_says_stays_when_hands_let_go_and_no_wall_goes_through_another(pair):
    assert 0.8 < pair.turns < min(pair.wound, 1.2)
    assert pair.quality["unwound"]["verdict"] == "good"
    assert pair.quality["unwound"]["turns"] == {"one and other": [round(pair.turns, 3), 1.0]}
    assert pair.quality["crossings"]["value"] == 0
    assert pair.quality["creep"]["verdict"] == "good"


@pytest.mark.long
def test_a_mirrored_loop_is_wound_like_a_left_handed_screw():
    loop = """
format: 1
name: wreath
units: cm
mirror: true
balloons:
  main: {size: 160, length: 45, tail: 4}
steps:
  - bubbles: {grip: 3}
  - loop: {wreath: 38}
    point: up
  - spiral: {bubbles: [wreath], turns: 1}
"""
    wreath = Wound(loop)
    assert wreath.wound == pytest.approx(-1.15, abs=0.25)
    assert wreath.turns == pytest.approx(-1.0, abs=0.3)
    assert wreath.quality["crossings"]["value"] == 0


@pytest.mark.parametrize("turns", [-2.0, 0.5, 3.0])
@pytest.mark.parametrize("strands", [2, 3, 5])
def test_turns_of_helices_are_counted_with_their_sense(turns, strands):
    along = np.linspace(0.0, 0.6, 61)
    ropes = []
    for k in range(strands):
        angle = math.tau * (turns * along / 0.6 + k / strands)
        ropes.append(np.stack([0.02 * np.cos(angle), 0.02 * np.sin(angle), along], axis=1))
    assert turns_of(ropes) == pytest.approx(turns, rel=1e-3)


def test_some_of_the_bubbles_between_two_joints_are_not_wound_without_the_others():
    three = PAIR.replace("length: 66", "length: 100")
    three += "  - bubbles: {third: 29}\n  - lock: {joints: [one.end, third.end]}\n"
    told = "third between the same joints would be wound, too, expected all that lie there"
    with pytest.raises(RecipeError, match=told):
        Recipe.parse(three + "  - spiral: {bubbles: [one, other]}\n")
    Recipe.parse(three + "  - spiral: {bubbles: [one, other, third]}\n")


def test_tubes_that_touch_lie_on_a_circle_and_two_take_four_widths_a_turn():
    assert [wound_radius(n) for n in (2, 3, 6)] == pytest.approx([0.5, 1.0 / math.sqrt(3.0), 1.0])
    # Two tubes 1 wide about one axis: helices 1/2 off it, at the pitch at which turns touch each other.
    length = tightest_turn(2)
    pitch = math.sqrt(length**2 - math.pi**2)
    assert 0.5 * pitch * math.pi / length == pytest.approx(1.0)
    assert length == pytest.approx(4.07, abs=0.01)


@pytest.mark.parametrize(
    ("step", "told"),
    [
        ("{bubbles: [one], turns: 1}", "one is no loop with two halves to wind"),
        ("{bubbles: [one, grip]}", "one and grip do not begin and end in the same two joints"),
        ("{bubbles: [one, one]}", "names a bubble twice"),
        ("{bubbles: [one, othr]}", "unknown bubble"),
        ("{bubbles: [one, other], turns: 0}", "0.5 to 10 turns"),
        ("{bubbles: [one, other], turns: 2}", "too short for 2 turns, expected at most 1.35"),
        ("{bubbles: [one, other], turn: 2}", "turns"),
        ("[one, other]", "spiral"),
        ("{bubbles: [one, other], turns: 1}\n  - spiral: {bubbles: [other, one]}", "wound 1 turn already"),
        ("{bubbles: []}", "bubbles"),
    ],
)
def test_what_cannot_be_wound_is_refused_with_what_would_go(step, told):
    with pytest.raises(RecipeError) as caught:
        plan(Recipe.parse(f"{PAIR}  - spiral: {step}\n"))
    assert told in str(caught.value)


@pytest.mark.parametrize(
    ("length", "advice"), [(15, "expected at most 0.7, or 41.6 cm"), (8, "for 2 turns, expected 41.6 cm")]
)
def test_fewer_turns_are_named_only_where_so_few_can_be_asked_for(length, advice):
    short = PAIR.replace("one: 29, other: 29", f"one: {length}, other: {length}")
    with pytest.raises(RecipeError) as caught:
        plan(Recipe.parse(f"{short}  - spiral: {{bubbles: [one, other], turns: 2}}\n"))
    assert advice in str(caught.value)


def test_what_is_left_of_a_balloon_ends_in_no_joint_and_a_popped_bubble_has_no_gas():
    rest = PAIR + "  - rest: end\n  - spiral: {bubbles: [one, end]}\n"
    with pytest.raises(RecipeError, match="one and end do not begin and end"):
        Recipe.parse(rest)
    popped = PAIR + "  - rest: end\n  - pop: end\n  - spiral: {bubbles: [one, end]}\n"
    with pytest.raises(RecipeError, match="was popped at"):
        Recipe.parse(popped)


def test_a_name_that_is_none_is_told_without_words_about_the_others():
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(PAIR + "  - spiral: {bubbles: [one, 3]}\n")
    assert len(str(caught.value).splitlines()) == 1


def test_what_is_wound_twice_has_all_its_turns_in_the_last_move():
    long = PAIR.replace("one: 29, other: 29", "one: 45, other: 45").replace("length: 66", "length: 100")
    figure = plan(Recipe.parse(long + 2 * "  - spiral: {bubbles: [one, other], turns: 0.5}\n"))
    winding = [move for move in figure.choreography.moves if isinstance(move, WindRound)]
    assert [(move.asked, move.turns) for move in winding] == [(0.5, 0.8), (1.0, 0.8)]


def test_unequal_strands_are_told():
    figure = plan(
        Recipe.parse(PAIR.replace("other: 29", "other: 24") + "  - spiral: {bubbles: [one, other]}\n")
    )
    assert any("one (29 cm) is longer than other (24 cm)" in str(each) for each in figure.cautions)


def test_bubbles_that_are_wound_tight_are_told():
    figure = plan(Recipe.parse(PAIR + "  - spiral: {bubbles: [one, other], turns: 1}\n"))
    (caution,) = (each for each in figure.cautions if "wound tight" in str(each))
    assert "29.1 cm" in str(caution)
