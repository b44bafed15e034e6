"""Round balloons in a plan: one bubble each, as wide as the recipe says."""

from __future__ import annotations

import math

import pytest

from balloon_usd.operations.moves import Loosen
from balloon_usd.plan import plan as plan_of
from balloon_usd.plan.drawing import plan_svg
from balloon_usd.plan.parking import parked
from balloon_usd.plan.report import plan_json, plan_text
from balloon_usd.recipe import Recipe, RecipeError

BALLS = """
format: 1
name: balls
units: cm
balloons:
  one: {{size: R11{filled}}}
  two: {{size: R5, inflated: 10}}
  three: {{size: R11}}
  four: {{size: R11}}
  five: {{size: R11}}
steps:
  - {{rest: belly, balloon: one}}
  - {{rest: head, balloon: two}}
  - tie: {{end: head.start, to: belly.start}}
"""
PUSHED = """
format: 1
name: pushed
units: cm
balloons:
  main: {{size: 260, tail: 12}}
  ball: {{size: R5, inflated: {width}}}
steps:
  - bubbles: {{left: 9.7, right: 9.7}}
    balloon: main
  - lock: [left, right]
  - {{rest: nose, balloon: ball}}
  - tie: {{end: nose.start, to: left.start}}
  - push: {{bubble: nose, through: [left, right]}}
"""


def balls(filled=""):
    return plan_of(Recipe.parse(BALLS.format(filled=filled)))


def test_it_is_full_if_nothing_is_said():
    strip = balls().strips["one"]
    assert 2.0 * strip.inflated_radius == pytest.approx(0.28)
    assert strip.bubbles[0].length == pytest.approx(1.17 * 0.28, rel=0.01)
    assert strip.bubbles[0].volume == pytest.approx(1.18 * math.pi / 6.0 * 0.28**3, rel=0.01)


def test_the_fuller_it_is_the_more_gas_it_has_and_the_higher_it_is_for_its_width():
    strips = [balls(f", inflated: {width}").strips["one"] for width in (16, 20, 24, 28)]
    gas = [strip.bubbles[0].volume for strip in strips]
    high = [strip.bubbles[0].length / strip.inflated_radius for strip in strips]
    assert gas == sorted(gas)
    assert high == sorted(high)


def test_it_has_no_tail_and_no_budget():
    made = balls()
    assert not any(strip.has_tail for strip in made.strips.values())
    assert made.budgets == {}


@pytest.mark.parametrize("width", [7, 29, 60])
def test_a_width_that_it_cannot_have_is_refused_with_those_that_it_can(width):
    with pytest.raises(RecipeError, match=r"expected a width of 7\.3 cm to 28 cm"):
        balls(f", inflated: {width}")


def test_they_lie_beside_each_other_until_they_are_joined():
    made = balls()
    places = parked(made.strips)
    walls = sorted(
        (place - strip.inflated_radius, place + strip.inflated_radius)
        for name, strip in made.strips.items()
        for place in [places[name]]
    )
    assert all(before[1] < after[0] for before, after in zip(walls, walls[1:], strict=False))


def test_plans_tell_how_wide_it_is():
    made = balls()
    assert "balloon two: R5, round, 2.6 cm wide flat" in plan_text(made)
    assert "blow up until it is 10 cm wide: 0.56 L" in plan_text(made)
    assert plan_json(made)["balloons"][1]["inflated_length"] == pytest.approx(0.105, rel=0.01)
    assert "two: R5, blown up to a width of 10 cm" in plan_svg(made)


def test_hands_loosen_their_grip_of_what_is_only_tied():
    assert any(isinstance(move, Loosen) for move in balls().choreography.moves)


@pytest.mark.parametrize(("width", "cautioned"), [(7, False), (8, True)])
def test_a_ball_that_is_too_wide_for_its_ring_is_cautioned(width, cautioned):
    told = [caution.what for caution in plan_of(Recipe.parse(PUSHED.format(width=width))).cautions]
    assert ("nose (8 cm wide) may not come through left and right" in told) == cautioned
