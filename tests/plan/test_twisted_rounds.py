"""Plans of round balloons that are twisted."""

from __future__ import annotations

import pytest

from balloon_usd.plan import plan as plan_of
from balloon_usd.plan.after_step import after_step, after_step_json, after_step_text
from balloon_usd.plan.drawing import plan_svg
from balloon_usd.plan.report import plan_text
from balloon_usd.recipe import Recipe, RecipeError

HEAD = """
format: 1
name: eyes
units: cm
balloons:
  pair: {size: R5, inflated: 9}
  egg: {size: R5, inflated: 5, color: yellow}
steps:
"""
REST = """
  - {rest: right, balloon: pair}
  - {rest: yolk, balloon: egg}
must_hold: planned
"""


def planned(*lines):
    steps = "".join(f"  - {line}\n" for line in lines)
    return plan_of(Recipe.parse(HEAD + steps + REST))


def refused(*lines):
    with pytest.raises(RecipeError) as caught:
        planned(*lines)
    (problem,) = caught.value.problems
    return str(problem)


def left(height, **more):
    keys = "".join(f", {key}: {value}" for key, value in more.items())
    return f"{{bubbles: {{left: {height}}}, balloon: pair{keys}}}"


def test_both_parts_share_wall_and_gas_and_are_harder_than_the_whole():
    strip = planned(left(6)).strips["pair"]
    first, last = strip.bubbles
    assert first.length == 0.06
    assert first.end == last.start
    assert first.rest_end == last.rest_start
    assert last.rest_end == strip.size.length
    assert first.volume + last.volume == pytest.approx(strip.blown.volume, rel=0.05)
    assert min(first.pressure, last.pressure) > strip.blown.pressure


def test_a_higher_first_part_leaves_a_lower_last_one():
    heights = [planned(left(height)).bubbles[1].length for height in (4, 5, 6, 7, 8)]
    assert heights == sorted(heights, reverse=True)


def test_each_part_is_as_wide_as_it_is_and_not_as_its_balloon():
    strip = planned(left(6)).strips["pair"]
    for bubble in strip.bubbles:
        assert bubble.length < strip.width_of(bubble) < strip.width


def test_the_plan_tells_both_parts_and_how_wide_it_is_blown_up_before():
    text = plan_text(planned(left(6)))
    assert "blow up until it is 9 cm wide: 0.39 L at 3.2 kPa" in text
    assert "left    bubble  6.0 cm     0.0     6.0" in text


def test_the_drawing_marks_the_joint_on_the_flat_balloon():
    whole = plan_svg(planned()).count("<line")
    # The mark, and the next decimetre on the ruler: twisted it is longer.
    assert plan_svg(planned(left(6))).count("<line") == whole + 2


@pytest.mark.parametrize(("height", "less"), [(1.5, ", or a balloon that is blown up less"), (12, "")])
def test_what_is_too_low_or_too_high_is_told_what_can_be_made(height, less):
    assert refused(left(height)) == (
        f'<text>:9:22: steps[0].bubbles.left: "left" of {height:g} cm is not twisted off pair, '
        f"expected 2.7 cm to 8.8 cm{less}"
    )


def test_what_would_lie_all_in_folds_is_told_what_can_be_made():
    problem = refused(left(4), "{bubbles: {nose: 5}, balloon: pair}")
    assert '"nose" of 5 cm would be 7.' in problem
    assert "wide, all in folds, expected" in problem


def test_its_heights_that_are_told_can_be_made():
    low, high = refused(left(12)).rsplit("expected ", 1)[1].replace(" cm", "").split(" to ")
    for height in (low, high):
        planned(left(height))


def test_no_gas_is_pressed_out_of_its_parts():
    problem = refused(left(6, burp="20 %"))
    assert problem.endswith("no gas is pressed out of bubbles of a round balloon, expected no such line")
    assert "steps[0].burp" in problem


def test_none_of_its_parts_is_closed_on_itself():
    problem = refused(left(6), "lock: {joints: [left.start, left.end]}")
    assert problem.endswith(
        "closes left: part of a R5, a round balloon with no side to bend, expected joints of others"
    )


def test_nothing_lies_in_one_that_is_twisted():
    text = HEAD.replace("R5, inflated: 9", "R11, inflated: 18")
    steps = ("insert: {egg: right}", "inflate: pair", "inflate: egg", left(8))
    with pytest.raises(
        RecipeError, match="part of a round balloon that is twisted, whose necks leave no room"
    ):
        plan_of(Recipe.parse(text + "".join(f"  - {step}\n" for step in steps) + REST))


def test_what_is_left_after_a_step_is_told():
    made = planned(left(6))
    text = after_step_text(after_step(made, 0))
    assert "left: 6.5 cm blown up at 4.9 kPa\n" in text
    assert after_step_json(after_step(made, 0))["balloons"][0]["left"]["length"] == made.bubbles[1].length


def test_nothing_is_advised_that_a_round_balloon_does_not_do():
    cautions = planned(left(6, turns=10)).cautions
    assert not any("ear" in caution.remedy.split() for caution in cautions)
    assert not any("draws rubber" in caution.why for caution in cautions)


@pytest.mark.parametrize("end", ["left.end", "right.start"])
def test_a_joint_in_its_middle_is_no_end_to_tie(end):
    tied = REST.replace("must_hold", f"  - tie: {{end: {end}, to: yolk.start}}\nmust_hold")
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(f"{HEAD}  - {left(6)}{tied}")
    told = f"{end} is no end of balloon pair, expected left.start; other joints are locked"
    assert told in str(caught.value)
