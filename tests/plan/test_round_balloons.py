"""Round balloons in a plan: one bubble each, as wide as the recipe says."""

from __future__ import annotations

import math
import re

import pytest

from balloon_usd.operations.moves import Loosen
from balloon_usd.plan import plan as plan_of
from balloon_usd.plan.drawing import plan_svg
from balloon_usd.plan.nesting import blown_volume, flat_length, flat_room, hosts_of, nozzle_length
from balloon_usd.plan.parking import parked
from balloon_usd.plan.pumping import pumped
from balloon_usd.plan.report import plan_json, plan_text
from balloon_usd.plan.twins import twins_of
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


EGG = """
format: 1
name: egg
units: cm
balloons:
  egg: {{size: R11, finish: clear}}
  bird: {{size: {size}}}
steps:
  - insert: {{bird: shell}}
  - inflate: egg
  - inflate: bird
  - {{rest: shell, balloon: egg}}
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


@pytest.mark.parametrize(("width", "cautioned"), [(8, False), (9, True)])
def test_a_ball_that_is_too_wide_for_its_ring_is_cautioned(width, cautioned):
    told = [caution.what for caution in plan_of(Recipe.parse(PUSHED.format(width=width))).cautions]
    assert ("nose (9 cm wide) may not come through left and right" in told) == cautioned


def egg(size):
    return plan_of(Recipe.parse(EGG.format(size=size)))


@pytest.mark.parametrize("size", ["R5, inflated: 8", "160, length: 3, tail: 1"])
def test_one_that_is_put_into_another_lies_within_its_flat_wall_and_leaves_it_less_gas(size):
    made, empty = egg(size), balls().strips["one"].bubbles[0].volume
    strips = made.strips
    host = hosts_of(strips)["bird"]
    first, last = flat_room(strips["egg"], strips["bird"])
    assert first + nozzle_length(strips["bird"]) <= host.along + 1e-9
    assert host.along + flat_length(strips["bird"]) <= last + 1e-9
    assert strips["egg"].bubbles[0].volume == pytest.approx(empty - blown_volume(strips["bird"]))


@pytest.mark.parametrize(
    ("size", "told"),
    [
        (
            "R11, inflated: 9",
            "is 5.6 cm wide while it is flat, and egg 5.6 cm, expected one of at most 4.2 cm",
        ),
        (
            "260, length: 20, tail: 3",
            "long with its nozzle and its flat tip, expected at most 32.6 cm in shell",
        ),
    ],
)
def test_what_does_not_fit_into_it_is_refused(size, told):
    with pytest.raises(RecipeError, match=re.escape(told)):
        egg(size)


TUCKED = PUSHED.replace(
    "push: {{bubble: nose, through: [left, right]}}", "tuck: {{bubble: nose, between: [left, right]}}"
)


@pytest.mark.parametrize(("width", "cautioned"), [(8, False), (9, True)])
def test_a_ball_that_is_too_wide_for_what_it_is_tucked_into_is_cautioned(width, cautioned):
    told = [caution.what for caution in plan_of(Recipe.parse(TUCKED.format(width=width))).cautions]
    assert ("nose (9 cm wide) may find no place in left and right" in told) == cautioned


HEART = """
format: 1
name: love
units: cm
balloons:
  {balloons}
steps:
  {steps}
"""


def heart(filled="", balloons="", steps="- {rest: heart, balloon: love}"):
    lines = "\n  ".join(filter(None, [f"love: {{size: H6{filled}}}", balloons]))
    return plan_of(Recipe.parse(HEART.format(balloons=lines, steps=steps)))


def test_a_heart_is_as_wide_as_its_name_says_and_nearly_as_high():
    strip = heart().strips["love"]
    assert 2.0 * strip.inflated_radius == pytest.approx(0.1525, rel=0.005)
    assert strip.bubbles[0].length == pytest.approx(0.937 * 0.1525, rel=0.01)
    assert "balloon love: H6, heart, 3.7 cm wide flat" in plan_text(heart())


@pytest.mark.parametrize("width", [5, 16])
def test_a_width_that_a_heart_cannot_have_is_refused_with_those_that_it_can(width):
    told = "a heart 3.7 cm wide while it is flat is not blown up to .*, expected a width of 6 cm to 15.2 cm"
    with pytest.raises(RecipeError, match=told):
        heart(f", inflated: {width}")


def test_strokes_of_a_pump_bring_what_a_flat_heart_does_not_hold():
    made = heart(steps="- {inflate: love, strokes: 3}\n  - {rest: heart, balloon: love}")
    assert (given := pumped(made, "love")) is not None
    bubble = made.strips["love"].bubbles[0]
    assert 3.0 * given.air == pytest.approx(1.04 * bubble.volume, rel=0.02)


IN_A_BALL = """- insert: {{{guest}}}
  - inflate: ball
  - inflate: love
  - {{rest: heart, balloon: love}}
  - {{rest: clear, balloon: ball}}"""


def test_a_heart_lies_in_a_round_balloon_its_neck_where_that_is_narrow():
    if_flat = "ball: {size: R11, finish: clear}"
    steps = IN_A_BALL.format(guest="love: clear").replace("  - {rest: heart, balloon: love}\n", "")
    strips = heart(", inflated: 9", if_flat, steps).strips
    host = hosts_of(strips)["love"]
    first, last = flat_room(strips["ball"], strips["love"])
    assert first + nozzle_length(strips["love"]) <= host.along + 1e-9
    assert host.along + flat_length(strips["love"]) <= last + 1e-9


def test_a_round_one_that_is_too_wide_for_another_is_told_how_wide_it_may_be():
    steps = IN_A_BALL.format(guest="love: clear").replace("  - {rest: heart, balloon: love}\n", "")
    ball = "ball: {size: R11, finish: clear, inflated: 14}"
    with pytest.raises(
        RecipeError, match=r"too large for clear, expected inflated: ([\d.]+) cm, or less"
    ) as told:
        heart(", inflated: 12", ball, steps)
    most = re.search(r"inflated: ([\d.]+) cm", str(told.value)).group(1)
    assert heart(f", inflated: {most}", ball, steps)
    with pytest.raises(RecipeError, match="too large for clear"):
        heart(f", inflated: {float(most) + 0.2}", ball, steps)


def test_nothing_lies_in_a_heart():
    steps = "- insert: {ball: heart}\n  - inflate: ball\n  - inflate: love\n  - {rest: heart, balloon: love}"
    with pytest.raises(RecipeError, match="lies in heart, a heart, whose lobes leave no room in it"):
        heart("", "ball: {size: R5, radius: 0.9, inflated: 4}", steps)


EARS = """
format: 1
name: mouse
units: cm
balloons:
  main: {size: 260, tail: 12}
  one: {size: R5, inflated: 8}
  other: {size: R5, inflated: 8}
steps:
  - bubbles: {nose: 5, left_cheek: 7, right_cheek: 7}
    balloon: main
  - lock: [left_cheek, right_cheek]
  - {rest: left_ear, balloon: one}
  - {rest: right_ear, balloon: other}
  - tie: {end: left_ear.start, to: nose.end}
  - tie: {end: right_ear.start, to: nose.end}
  - aim: {left_ear: [up, left], right_ear: [up, right]}
"""


def test_two_of_them_are_twins_and_are_set_straight():
    made = plan_of(Recipe.parse(EARS))
    assert ("left_ear", "right_ear") in {(a.name, b.name) for a, b in twins_of(made.recipe, made.strips)}
