"""What the plan makes of twins: hands set a finished figure straight."""

from __future__ import annotations

import pytest

from balloon_usd.operations.moves import Straighten
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe

CAT = """
format: 1
name: cat
units: cm
balloons: {main: {size: 260, tail: 20}}
steps:
  - bubbles: {nose: 5, left_ear: 5, right_ear: EAR}
  - lock: [left_ear, right_ear]
  - rest: tail
"""


def moves_of(end="", ear="5", text=CAT):
    return plan(Recipe.parse(text.replace("EAR", ear) + end)).choreography.moves


def straightens(*what, **how):
    return [move for move in moves_of(*what, **how) if isinstance(move, Straighten)]


def test_hands_set_a_figure_with_twins_straight_after_its_hold():
    moves = moves_of()
    assert [type(move).__name__ for move in moves[-4:]] == ["Hold", "Straighten", "LetGo", "Hold"]
    (move,) = straightens()
    assert (move.twins, move.between) == ((("left_ear", "right_ear"),), ("nose", "tail"))


@pytest.mark.parametrize("how", [{"end": "symmetric: false"}, {"ear": "6"}])
def test_nothing_is_set_straight_where_a_recipe_wants_it_so_or_says_different_things_of_both_sides(how):
    assert straightens(**how) == []


@pytest.mark.parametrize(
    ("left", "right", "count"),
    [("left", "right", 1), ("up", "up", 1), ("up", "down", 0), ("left", "left", 0)],
)
def test_what_points_elsewhere_than_its_mirror_image_is_no_twin(left, right, count):
    steps = f"""
  - bubbles: {{nose: 8}}
  - loop: {{left_ring: 30}}
    point: {left}
  - loop: {{right_ring: 30}}
    point: {right}
"""
    text = CAT[: CAT.index("steps:")] + "steps:" + steps
    assert sum(len(move.twins) for move in straightens(text=text)) == count


def test_frozen_joints_are_not_bent():
    text = CAT.replace("tail: 20", "capsule: 40")
    assert straightens("physics: {model: kosaka}", text=text) == []


def test_what_a_recipe_aims_bends_or_points_aside_is_left_there():
    text = CAT.replace("  - rest", "  - aim: {nose: [forward, left]}\n  - rest") + "  - bend: {tail: 90}\n"
    (move,) = straightens(text=text)
    assert move.between == ()


def test_feet_are_levelled_after_a_figure_has_been_set_straight():
    names = [type(move).__name__ for move in moves_of("pose: stand")]
    assert names.index("Straighten") < names.index("Level") < names.index("SetDown")


def test_creep_is_measured_until_hands_take_the_figure_up_again():
    made = plan(Recipe.parse(CAT.replace("EAR", "5"))).choreography
    (move,) = (each for each in made.moves if isinstance(each, Straighten))
    assert made.taken_up == move.start
    left = plan(Recipe.parse(CAT.replace("EAR", "5") + "symmetric: false")).choreography
    assert left.taken_up == left.seconds


@pytest.mark.parametrize(
    ("later", "count"),
    [
        ("aim: {left_arm: up}", 0),
        ("aim: {left_arm: up, right_arm: up}", 1),
        ("aim: {left_arm: [left, up], right_arm: [up, right]}", 1),
        ("pop: right_arm", 0),
        ("push: {bubble: nose, through: [left_arm]}", 1),
    ],
)
def test_what_is_done_later_with_one_of_both_alone_makes_them_no_twins(later, count):
    steps = f"""
  - bubbles: {{nose: 4}}
  - loop: {{left_arm: 30}}
    point: left
  - loop: {{right_arm: 30}}
    point: right
  - rest: tail
  - {later}
"""
    text = CAT[: CAT.index("steps:")] + "steps:" + steps
    assert sum(len(move.twins) for move in straightens(text=text)) == count


@pytest.mark.parametrize(("bent", "count"), [("left_leg: 60", 0), ("left_leg: 60, right_leg: 60", 1)])
def test_legs_of_which_one_alone_is_bent_are_no_twins(bent, count):
    steps = f"""
  - bubbles: {{nose: 4, left_leg: 14, right_leg: 14}}
  - lock: [left_leg, right_leg]
    point: down
  - rest: tail
  - bend: {{{bent}}}
"""
    text = CAT[: CAT.index("steps:")] + "steps:" + steps
    assert sum(len(move.twins) for move in straightens(text=text)) == count
