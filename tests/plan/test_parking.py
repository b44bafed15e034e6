"""Where balloons lie until they are joined, and the moves that lead them in."""

from __future__ import annotations

import pytest

from balloon_usd.operations.moves import Bring, LeadIn
from balloon_usd.operations.score import LEADING_IN_SPEED
from balloon_usd.plan import plan as plan_of
from balloon_usd.plan.parking import parked
from balloon_usd.plan.report import plan_json, plan_text
from balloon_usd.recipe import Recipe

THREE = """
format: 1
name: three
units: cm
{tempo}
balloons:
  red: {{size: 260, length: 20, tail: 4}}
  blue: {{size: 260, length: 20, tail: 4}}
  green: {{size: 260, length: 20, tail: 4}}
steps:
  - {{bubbles: {{nose: 10, body: 20}}, balloon: red}}
  - {{bubbles: {{arm: 6, hand: 6}}, balloon: blue}}
  - {{bubbles: {{leg: 8}}, balloon: green}}
  - lock: {{joints: {joints}}}
  - lock: {{joints: [hand.end, leg.end]}}
  - {{rest: red_rest, balloon: red}}
  - {{rest: blue_rest, balloon: blue}}
  - {{rest: green_rest, balloon: green}}
"""


def three(joints="[nose.end, arm.end]", tempo=""):
    return plan_of(Recipe.parse(THREE.format(joints=joints, tempo=tempo)))


def led_in(plan):
    """The leading in of a plan as names of the moving ring and the held one, and the moves."""
    moves = [move for move in plan.choreography.moves if isinstance(move, LeadIn)]
    name = [ring.name for ring in plan.table.rings]
    return [(name[move.ring], name[move.to]) for move in moves], moves


def test_the_first_balloon_lies_before_the_maker_and_the_others_to_both_sides_beyond_its_longest_bubble():
    places = parked(three().strips)
    assert places == pytest.approx({"red": 0.0, "blue": 0.5, "green": -0.5})


def test_a_balloon_is_led_in_just_before_its_joint_is_brought_to_the_figure():
    plan = three()
    names, moves = led_in(plan)
    assert names == [("arm.end", "nose.end"), ("leg.end", "hand.end")]
    for move in moves:
        following = plan.choreography.moves[plan.choreography.moves.index(move) + 1]
        assert isinstance(following, Bring)
        assert (following.ring, following.to) == (move.ring, move.to)


def test_what_lies_farther_off_comes_whatever_is_named_first():
    names, _ = led_in(three("[arm.end, nose.end]"))
    assert names[0] == ("arm.end", "nose.end")


def test_balloons_that_hang_together_already_are_not_led_in_again():
    names, _ = led_in(three("[arm.end, leg.start]"))
    assert names == [("green.knot", "arm.end")]


def test_a_lock_of_three_balloons_leads_in_two():
    names, _ = led_in(three("[nose.start, arm.end, leg.start]"))
    assert names == [("arm.end", "red.knot"), ("green.knot", "arm.end")]


def test_the_plan_tells_which_step_leads_in_what_from_where():
    plan = three()
    text, data = plan_text(plan), plan_json(plan)["balloons"]
    assert "step 4 leads in blue from the right" in text
    assert "step 5 leads in green from the left" in text
    assert [(each["aside"], each["led_in"]) for each in data] == [(0.0, None), (0.5, 3), (-0.5, 4)]


def test_in_a_mirror_they_are_led_in_from_the_other_side():
    plan = plan_of(Recipe.parse(three().recipe.to_yaml() + "mirror: true\n"))
    text, data = plan_text(plan), plan_json(plan)["balloons"]
    assert "mirrored: what points left comes out right" in text
    assert "step 4 leads in blue from the left" in text
    assert [each["aside"] for each in data] == [0.0, -0.5, 0.5]


def test_leading_in_takes_the_time_of_its_way_at_the_tempo():
    (calm, _), (brisk, _) = led_in(three())[1], led_in(three(tempo="tempo: brisk"))[1]
    assert calm.seconds == pytest.approx((0.5**2 + 0.04**2) ** 0.5 / LEADING_IN_SPEED)
    assert brisk.seconds == pytest.approx(calm.seconds / 1.5)
