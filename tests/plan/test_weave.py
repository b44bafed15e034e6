"""Rows that are woven: a bubble and a lock in turns, as steps of their own would make them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from balloon_usd.plan import plan, plan_text
from balloon_usd.recipe import Recipe, RecipeBuilder, RecipeError

HEAD = """
format: 1
name: ladder
units: cm
balloons:
  red: {size: 260, length: 20, tail: 8}
  white: {size: 260, length: 20, tail: 8}
steps:
  - {bubbles: {a: 7, b: 7}, balloon: red}
"""
WOVEN = HEAD + "  - {weave: {bubbles: {c: 7, d: 7}, to: [a.start, a.end, b.end]}, balloon: white}\n"
STEP_BY_STEP = (
    HEAD
    + """
  - {bubbles: {c: 7}, balloon: white}
  - lock: {joints: [a.start, c.start]}
  - lock: {joints: [a.end, c.end]}
  - {bubbles: {d: 7}, balloon: white}
  - lock: {joints: [b.end, d.end]}
"""
)


def test_a_row_is_made_by_the_moves_of_bubbles_and_locks_in_turns():
    woven, by_step = (plan(Recipe.parse(text)) for text in (WOVEN, STEP_BY_STEP))
    same = [[replace(move, step=0, text="") for move in each.choreography.moves] for each in (woven, by_step)]
    assert same[0] == same[1]
    assert woven.strips == {
        name: replace(
            strip, bubbles=tuple(replace(b, step=w.step) for b, w in zip(strip.bubbles, each, strict=True))
        )
        for (name, strip), each in zip(
            by_step.strips.items(), (s.bubbles for s in woven.strips.values()), strict=True
        )
    }
    assert [joint.ends for joint in woven.graph.joints] == [joint.ends for joint in by_step.graph.joints]


def test_its_joints_are_told_one_by_one_and_its_balloon_is_led_in_once():
    told = plan_text(plan(Recipe.parse(WOVEN)))
    assert told.count("leads in white") == 1
    assert [
        told.count(f"weaves {pair}") for pair in ("a.start, c.start", "a.end, c.end", "b.end, d.end")
    ] == [1] * 3


def test_a_row_without_a_joint_for_its_start_hangs_on_its_ends():
    woven = plan(Recipe.parse(WOVEN.replace("a.start, ", "")))
    assert sorted(len(joint.ends) for joint in woven.graph.joints) == [1, 1, 1, 1, 4, 4]


def test_it_is_written_by_the_builder_as_in_a_file():
    builder = RecipeBuilder("ladder")
    for name in ("red", "white"):
        builder = builder.balloon(name, size=260, length=0.2, tail=0.08)
    builder = builder.bubbles(a=0.07, b=0.07, balloon="red")
    builder = builder.weave({"c": 0.07, "d": "7 cm"}, ["a.start", "a.end", "b.end"], balloon="white")
    built = builder.build()
    assert built.steps[1] == Recipe.parse(WOVEN).steps[1]
    assert Recipe.parse(built.to_yaml()).steps == built.steps


@pytest.mark.parametrize(
    ("row", "told"),
    [
        (
            "{bubbles: {c: 7, d: 7}, to: [a.end]}",
            "1 joints for 2 bubbles, expected as many, or one more",
        ),
        (
            "{bubbles: {c: 7}, to: [a.start, a.end, b.end]}",
            "3 joints for 1 bubbles, expected as many",
        ),
        ("{bubbles: {c: 7}, to: [x.end]}", 'unknown bubble "x"'),
        ("{bubbles: {c: 7}, to: [a]}", '"a" is no joint, expected a bubble and its end'),
        ("{bubbles: {a: 7}, to: [b.end]}", 'bubble "a" was made at'),
        ("{bubbles: {c: 7, d: 7}, to: [a.end, a.end]}", None),
        ("{bubbles: {c: 7}}", "weave.to: is missing"),
        ("{bubbles: {}, to: [a.end]}", "bubbles"),
        ("{bubbles: {c: 70}, to: [a.end]}", "c"),
        ("[c, d]", "weave"),
    ],
)
def test_a_row_that_cannot_be_woven_is_refused_with_its_place(row, told):
    text = HEAD + f"  - {{weave: {row}, balloon: white}}\n"
    if told is None:
        assert plan(Recipe.parse(text))
        return
    with pytest.raises(RecipeError, match=told) as refused:
        plan(Recipe.parse(text))
    assert "steps[1]" in str(refused.value)


def test_a_row_of_several_balloons_says_of_which_it_is():
    with pytest.raises(
        RecipeError, match="does not say on which balloon, expected balloon: one of red, white"
    ):
        Recipe.parse(WOVEN.replace("]}, balloon: white}", "]}}"))


def test_no_row_is_woven_to_the_tip_of_a_balloon():
    tip = (
        HEAD
        + "  - {rest: end, balloon: red}\n  - {weave: {bubbles: {c: 7}, to: [end.end]}, balloon: white}\n"
    )
    with pytest.raises(RecipeError, match=r"end\.end is the tip of its balloon and cannot be twisted"):
        plan(Recipe.parse(tip))
