"""Plans of round balloons that are blown up farther, and let down."""

from __future__ import annotations

import pytest

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.operations.moves import Inflate, LetDown
from balloon_usd.plan import plan as plan_of
from balloon_usd.plan.drawing import plan_svg
from balloon_usd.plan.overblowing import bursting_width, load_of
from balloon_usd.plan.parking import parked
from balloon_usd.plan.pumping import pumped
from balloon_usd.plan.report import plan_json, plan_text
from balloon_usd.recipe import Recipe, RecipeError

ONE = """
format: 1
name: one
units: cm
balloons:
  one: {{size: {size}, inflated: {width}{more}}}
steps:
  - {{rest: whole, balloon: one}}
"""


def planned(size="R5", width=9, overblown=None, extra=""):
    more = extra + ("" if overblown is None else f", overblown: {overblown}")
    return plan_of(Recipe.parse(ONE.format(size=size, width=width, more=more)))


def refused(**of):
    with pytest.raises(RecipeError) as caught:
        planned(**of)
    (problem,) = caught.value.problems
    return str(problem)


def test_it_is_as_wide_as_without_and_half_as_hard():
    before, after = (planned(overblown=most).bubbles[0] for most in (None, 13))
    assert after.length == before.length
    assert after.volume == before.volume
    assert after.pressure == pytest.approx(0.51 * before.pressure, rel=0.02)


def test_the_farther_it_was_blown_up_the_softer_it_is():
    pressures = [planned(overblown=most).bubbles[0].pressure for most in (9.2, 10, 11, 13, 17)]
    assert pressures == sorted(pressures, reverse=True)
    assert pressures[0] > 1.3 * pressures[-1]


def test_rubber_that_does_not_soften_stays_as_hard():
    text = ONE.format(size="R5", width=9, more=", overblown: 13") + "physics: {softening: false}\n"
    made = plan_of(Recipe.parse(text))
    assert made.bubbles[0].pressure == planned().bubbles[0].pressure
    assert "one is overblown for nothing" in [caution.what for caution in made.cautions]


def test_hands_blow_it_up_wait_and_let_air_out():
    moves = planned(overblown=13).choreography.moves
    (blowing,) = (move for move in moves if isinstance(move, Inflate))
    (letting,) = (move for move in moves if isinstance(move, LetDown))
    assert letting.start > blowing.end
    assert letting.text == "let air out: one"
    assert not any(isinstance(move, LetDown) for move in planned().choreography.moves)


def test_the_plan_tells_both_widths_and_how_near_it_comes_to_bursting():
    made = planned(overblown=16)
    text = plan_text(made)
    assert "blow up until it is 16 cm wide: 2.7" in text
    assert "60% of burst" in text
    assert "let air out until it is 9 cm wide: 0.39 L at 1.6 kPa" in text
    told = plan_json(made)["balloons"][0]["overblown"]
    assert told["width"] == 0.16
    assert told["pressure"] == made.strips["one"].blown.before.pressure
    assert told["load"] == pytest.approx(0.6, abs=0.01)
    assert plan_json(planned())["balloons"][0]["overblown"] is None
    assert "blown up to a width of 9 cm, from 16 cm" in plan_svg(made)


@pytest.mark.parametrize(("size", "least"), [("R5", 0.18), ("R11", 0.37)])
def test_it_bursts_where_its_load_is_one_and_the_plan_warns_before(size, least):
    found = bursting_width(rubber_named(), size_named(size))
    assert least < found < 1.03 * least
    assert load_of(rubber_named(), size_named(size), found) == pytest.approx(1.0)
    (caution,) = planned(size, 10, round(99.5 * found, 1)).cautions
    assert caution.what.startswith("one may burst where it is blown up to ")
    remedy = float(caution.remedy.removeprefix("overblown: ").removesuffix(" cm"))
    assert not planned(size, 10, remedy).cautions


@pytest.mark.parametrize("overblown", [8, 9])
def test_what_is_not_above_the_width_in_the_end_is_refused(overblown):
    assert refused(overblown=overblown) == (
        "<text>:6:43: balloons.one.overblown: air is let out down to 9 cm, which "
        f"{overblown} cm is not above, expected 9.1 cm to 18.4 cm"
    )


def test_what_bursts_it_is_refused_with_what_does_not():
    assert refused(overblown=20).endswith(
        "a round balloon 2.6 cm wide while it is flat is not blown up to 20 cm, at which it bursts, "
        "expected 9.1 cm to 18.4 cm"
    )
    planned(overblown=18.4)


def test_a_heart_is_blown_up_to_its_full_width_before():
    assert planned("H11", 20, 28).bubbles[0].pressure < 0.6 * planned("H11", 20).bubbles[0].pressure
    assert refused(size="H11", width=20, overblown=30).endswith(
        "is not blown up to 30 cm, which tears it in its cleft, expected 20.1 cm to 28 cm"
    )


@pytest.mark.parametrize(("size", "width"), [("H6", 15.2), ("H11", 28)])
def test_a_full_heart_is_not_blown_up_farther(size, width):
    problem = refused(size=size, width=width, overblown=width)
    assert problem.endswith("and not blown up farther, expected inflated: less than that")


def test_a_full_width_that_the_recipe_does_not_say_is_told():
    with pytest.raises(RecipeError, match=r"down to its full width of 13 cm, .*or inflated: less than that"):
        plan_of(
            Recipe.parse(
                ONE.format(size="R5", width="13", more=", overblown: 13").replace("inflated: 13, ", "")
            )
        )


EGG = """
format: 1
name: egg
units: cm
balloons:
  egg: {{size: R11, finish: clear, inflated: 13, overblown: 28}}
  bird: {{size: R5, inflated: {width}, overblown: {most}}}
steps:
  - insert: {{bird: shell}}
  - inflate: egg
  - inflate: bird
  - {{rest: shell, balloon: egg}}
"""


@pytest.mark.parametrize(("width", "most", "key"), [(6, 12, "overblown"), (12, 12.5, "inflated")])
def test_one_that_is_too_large_for_another_before_air_is_let_out_is_told_what_fits(width, most, key):
    with pytest.raises(RecipeError) as caught:
        plan_of(Recipe.parse(EGG.format(width=width, most=most)))
    told = str(caught.value)
    assert f"is {most:g} cm wide when blown up" in told
    fits = told.split(f"expected {key}: ")[1].split(" cm", maxsplit=1)[0]
    text = EGG.format(width=width, most=fits)
    if key == "inflated":
        text = EGG.format(width=fits, most=most).replace(f", overblown: {most}", "")
    plan_of(Recipe.parse(text))


def test_a_full_one_goes_beyond():
    made = planned(width=13, overblown=16).strips["one"]
    assert made.blown.before.volume > 1.9 * made.blown.volume


def test_strokes_of_a_pump_bring_the_air_of_its_widest():
    text = ONE.format(size="R5", width=9, more=", overblown: 13").replace(
        "steps:", "steps:\n  - {inflate: one, strokes: 5}"
    )
    made = plan_of(Recipe.parse(text))
    air = pumped(made, "one").air
    assert 5.0 * air > 3.0 * made.bubbles[0].volume


def test_others_lie_where_it_does_not_reach_them():
    two = ONE.replace("steps:", "  two: {{size: R5}}\nsteps:\n  - {{rest: other, balloon: two}}")
    near, far = (
        parked(plan_of(Recipe.parse(two.format(size="R11", width=18, more=more))).strips)["two"]
        for more in ("", ", overblown: 36")
    )
    assert abs(far) == pytest.approx(abs(near) + 0.09)


def test_one_that_is_twisted_is_softer_in_all_its_parts():
    twisted = ONE.replace("  - {{rest", "  - {{bubbles: {{first: 5.5}}, balloon: one}}\n  - {{rest")
    twisted += "must_hold: planned\n"
    before, after = (
        plan_of(Recipe.parse(twisted.format(size="R5", width=9, more=more))).bubbles
        for more in ("", ", overblown: 13")
    )
    for old, new in zip(before, after, strict=True):
        assert new.length == pytest.approx(old.length, rel=0.05)
        assert new.pressure < 0.75 * old.pressure
