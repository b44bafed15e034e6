"""What the plan makes of poses in which a figure falls."""

from __future__ import annotations

import pytest

from balloon_usd.operations.moves import Fall, Level, SetDown
from balloon_usd.plan import plan
from balloon_usd.plan.posing import LANDING_SECONDS, POSED_SECONDS, SLOW_FALL
from balloon_usd.recipe import Recipe

PAIR = """
format: 1
name: pair
units: cm
balloons: {main: {size: 260, tail: 20}}
steps:
  - bubbles: {a: 5, b: 5}
"""


def moves_of(end):
    return plan(Recipe.parse(PAIR + end)).choreography.moves


def last_moves(end):
    return moves_of(end)[-2:]


@pytest.mark.parametrize("end", ["", "pose: hold", "pose: hang", "pose: stand\nphysics: {gravity: 0}"])
def test_nothing_falls_that_hands_or_a_thread_hold_or_that_has_no_weight(end):
    assert not any(isinstance(move, Fall) for move in last_moves(end))


def test_a_figure_is_lifted_before_it_is_dropped_and_shown_until_it_lies():
    lift, fall = last_moves("pose: drop\nheight: 150")
    assert isinstance(lift, SetDown)
    assert isinstance(fall, Fall)
    assert (lift.pose, lift.height, lift.text, fall.text) == ("drop", 1.5, "lift up", "fall")
    assert (fall.gravity, fall.velocity, fall.ground) == (9.81, (0.0, 0.0, 0.0), True)
    assert fall.seconds == pytest.approx(1.5 / SLOW_FALL + LANDING_SECONDS)


def test_a_figure_falls_longer_where_gravity_is_weak():
    (_, here), (_, there) = (last_moves(f"pose: drop\nphysics: {{gravity: {g}}}") for g in (9.81, 9.81 / 4))
    assert there.seconds == pytest.approx(2.0 * here.seconds)


def test_a_figure_that_is_shown_for_no_time_does_not_fall():
    assert not any(isinstance(move, Fall) for move in last_moves("physics: {gravity: 9.81, hold: 0}"))


def test_a_figure_is_lifted_high_no_faster_than_one_metre_a_second():
    lift, _ = last_moves("pose: drop\nheight: 6 m")
    assert lift.seconds == 6.0


def test_a_figure_is_thrown_ahead():
    _, fall = last_moves("pose: throw\nspeed: 5")
    assert (fall.velocity, fall.text) == ((-5.0, 0.0, 0.0), "fly")


def test_a_figure_stands_by_its_weight():
    _, fall = last_moves("pose: stand")
    assert isinstance(fall, Fall)
    assert (fall.seconds, fall.text) == (POSED_SECONDS, "stand")


def test_the_feet_of_a_figure_are_levelled_before_it_is_set_down_to_stand():
    names = [type(move).__name__ for move in moves_of("pose: stand")]
    assert names[-6:] == ["Hold", "Level", "LetGo", "Hold", "SetDown", "Fall"]
    for pose in ("hang", "hold", "drop", "stand\nphysics: {gravity: 0}"):
        assert not any(isinstance(move, Level) for move in moves_of(f"pose: {pose}"))


RING = """
format: 1
name: ring
units: cm
balloons: {main: {size: 260, length: 50, tail: 15}}
steps:
  - bubbles: {a: 8, b: 8, c: 8}
  - lock: {joints: [a.start, c.end]}
  - rest: spare
  - cut: spare
pose: stand
"""


def test_of_a_closed_ring_nothing_hangs_on_one_joint_and_so_no_feet_are_levelled():
    made = plan(Recipe.parse(RING))
    assert not made.recipe.piece.has_limbs
    assert not any(isinstance(move, Level) for move in made.choreography.moves)


def test_feet_of_a_figure_that_comes_apart_are_not_levelled():
    text = """
format: 1
name: apart
units: cm
balloons:
  main: {size: 260, length: 22, tail: 10}
steps:
  - bubbles: {front: 6, one: 7, two: 7}
  - lock: [one, two]
  - bubbles: {gap: 5}
  - ear: {knob: 3}
pose: stand
"""
    levelled = [
        any(isinstance(move, Level) for move in plan(Recipe.parse(each)).choreography.moves)
        for each in (text, text.replace("pose", "  - pop: gap\npose"))
    ]
    assert levelled == [True, False]
    assert plan(Recipe.parse(PAIR)).recipe.piece.has_limbs


def test_a_figure_that_stays_where_it_was_made_has_no_ground_to_fall_on():
    hold, fall = last_moves("physics: {gravity: 9.81, hold: 1.5}")
    assert fall.start == hold.end
    assert (fall.ground, fall.seconds) == (False, 1.5)
