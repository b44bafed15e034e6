"""Bubbles that are there are closed: what is read, what is refused, and what hands do."""

from __future__ import annotations

import pytest

from balloon_usd.operations.ear import Ear
from balloon_usd.operations.loop import Loop
from balloon_usd.operations.moves import Gather, Pinch, Spin, Weld
from balloon_usd.operations.tulip_link import TulipLink
from balloon_usd.plan import plan
from balloon_usd.plan.report import plan_text
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.recipe.builder import RecipeBuilder

HEAD = """\
format: 1
name: head
units: cm
balloons:
  main: {size: 260, inflated: 60}
steps:
  - bubbles: {left_cheek: 8, left_ear: 4, forehead: 6, right_ear: 4, right_cheek: 8}
  - lock: {joints: [left_cheek.start, right_cheek.end]}
  - %s
  - rest: neck
"""
TWO = """\
format: 1
name: two
units: cm
balloons:
  red: {size: 260, inflated: 40}
  blue: {size: 260, inflated: 40}
steps:
  - {bubbles: {a: 8, b: 4}, balloon: red}
  - {bubbles: {c: 8}, balloon: blue}
  - lock: {joints: [a.start, c.end]}
  - ear: b
"""


def refused(step: str) -> str:
    with pytest.raises(RecipeError) as caught:
        plan(Recipe.parse(HEAD % step))
    return str(caught.value)


@pytest.mark.parametrize(
    ("step", "closed"),
    [("ear: left_ear", ["left_ear"]), ("ear: [left_ear, right_ear]", ["left_ear", "right_ear"])],
)
def test_the_ends_of_bubbles_that_are_there_become_one(step: str, closed: list[str]) -> None:
    recipe = Recipe.parse(HEAD % step)
    assert [name for name in recipe.piece.bubbles if recipe.piece.is_closed([name])] == closed


def test_hands_twist_no_neck_anew_that_is_there() -> None:
    planned = plan(Recipe.parse(HEAD % "ear: [left_ear, right_ear]"))
    work = (Pinch, Spin, Gather, Weld)
    own = [type(move) for move in planned.choreography.moves if move.step == 2 and isinstance(move, work)]
    assert own == [Gather, Weld, Gather, Weld]


def test_what_becomes_an_ear_later_is_given_the_rubber_and_the_gas_of_an_ear_at_once() -> None:
    later = plan(Recipe.parse(HEAD % "ear: left_ear")).bubbles
    at_once = plan(Recipe.parse(Ear.example)).bubbles
    ear = next(bubble for bubble in at_once if bubble.name == "left_ear")
    found = next(bubble for bubble in later if bubble.name == "left_ear")
    assert (found.kind, found.gas, found.slack) == (ear.kind, ear.gas, ear.slack)
    assert found.rest_length == pytest.approx(ear.rest_length)
    assert [bubble.kind for bubble in later if bubble.name == "right_ear"] == ["bubble"]


def test_what_a_tulip_link_is_twisted_over_becomes_no_tulip() -> None:
    root = "  - bubbles: {root: 3}\n    balloon: fire\n  - rest: flame"
    candle = TulipLink.example.replace("  - rest: flame", root).replace("over: flame", "over: root")
    bubbles = {bubble.name: bubble for bubble in plan(Recipe.parse(candle)).bubbles}
    assert (bubbles["root"].kind, bubbles["root"].slack) == ("bubble", 1.0)
    assert bubbles["socket"].kind == "tulip"


def test_gas_that_is_pressed_out_of_a_bubble_is_missing_in_its_ear_too() -> None:
    soft = (HEAD % "ear: left_ear").replace("right_cheek: 8}", "right_cheek: 8}\n    burp: 20 %")
    found = {bubble.name: bubble.gas for bubble in plan(Recipe.parse(soft)).bubbles}
    assert found["left_ear"] == pytest.approx(0.8 * Ear.gas)


def test_a_bubble_names_its_balloon_itself() -> None:
    recipe = Recipe.parse(TWO)
    assert recipe.piece.is_closed(["b"])


def test_a_loop_of_a_bubble_that_is_there_is_held_like_any_loop() -> None:
    text = "format: 1\nname: wing\nunits: cm\nballoons:\n  main: {size: 260, inflated: 60}\nsteps:\n"
    later = plan(Recipe.parse(text + "  - bubbles: {head: 5, wing: 24}\n  - loop: wing\n"))
    at_once = plan(Recipe.parse(text + "  - bubbles: {head: 5}\n  - loop: {wing: 24}\n"))
    assert len(later.table.guides("wing")) == len(at_once.table.guides("wing")) == len(Loop.guides)


def test_the_plan_says_which_bubbles_a_step_closes() -> None:
    text = plan_text(plan(Recipe.parse(HEAD % "ear: left_ear")))
    assert "step 3 closes left_ear.start, left_ear.end" in text


@pytest.mark.parametrize(
    ("step", "told"),
    [
        ("ear: nobody", 'steps[2].ear: unknown bubble "nobody"'),
        ("ear: neck", 'bubble "neck" does not exist yet, it is made at steps[3].rest'),
        ("ear: [left_ear, left_ear]", "left_ear.start, left_ear.end: these joints are already one"),
        ("ear: [left_ear, 3]", "3 is no name"),
        ("ear: []", "is empty, expected at least one entry"),
        ("ear: 3", "3 does not fit, expected entries such as {nose: 10}"),
        (
            "fold: left_ear",
            "make a ball, wider than long, with no side to bend, expected ear instead of fold",
        ),
        (
            "{ear: left_ear, burp: 20 %}",
            "burp: presses gas out before a bubble is twisted off, expected it where left_ear is made",
        ),
        ("{ear: {left_ear: 4}}", 'bubble "left_ear" was made at steps[0].bubbles.left_ear'),
    ],
)
def test_what_cannot_be_closed_is_told_with_its_place(step: str, told: str) -> None:
    assert told in refused(step)


def test_what_is_left_of_a_balloon_has_a_tip_in_place_of_a_joint() -> None:
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(f"{HEAD % 'ear: left_ear'}  - loop: neck\n")
    assert "expected tie: {end: neck.end, to: neck.start}" in str(caught.value)


def test_bubbles_that_are_there_are_named_in_python_as_in_a_file() -> None:
    builder = RecipeBuilder("head").balloon("main", size="260", inflated=0.6)
    builder.bubbles(left_cheek=0.08, left_ear=0.04, forehead=0.06, right_ear=0.04, right_cheek=0.08)
    builder.lock(joints=["left_cheek.start", "right_cheek.end"])
    one, two = (
        builder.ear("left_ear").ear(["right_ear"]).rest("neck").build(),
        Recipe.parse((HEAD % "ear: left_ear").replace("  - rest", "  - ear: right_ear\n  - rest")),
    )
    assert [step.entry("cm") for step in one.steps] == [step.entry("cm") for step in two.steps]


def test_names_beside_lengths_are_refused_in_python() -> None:
    builder = RecipeBuilder("head").balloon("main", size="260", inflated=0.6).bubbles(a=0.04)
    with pytest.raises(TypeError, match="names bubbles beside lengths of new ones"):
        builder.ear("a", b=0.04)
