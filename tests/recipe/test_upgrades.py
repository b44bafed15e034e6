"""Older words of the language are read as today's, and problems point at what was written."""

from __future__ import annotations

import pytest
import yaml

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeBuilder, RecipeError, recipe_schema

OLD = """\
format: 1
name: old
units: cm
balloons:
  main: {size: 260, color: blue, tail: 10}
steps:
  - bubbles: {a: 10}
  - note: gently
    push: {bubble: a, depth: 1.5}
  - push: {bubble: a, force: 2 N}
    point: left
  - rest: b
"""
NOTICES = [
    "old.yaml:9:5: push is called press now: press: {...}",
    "old.yaml:10:5: push is called press now: press: {...}",
]


def problems(text: str) -> list[str]:
    with pytest.raises(RecipeError) as caught:
        plan(Recipe.parse(text, file="old.yaml"))
    return str(caught.value).splitlines()


def test_push_with_a_depth_or_a_force_is_read_as_press() -> None:
    assert Recipe.parse(OLD) == Recipe.parse(OLD.replace("push:", "press:"))


def test_a_notice_names_the_new_word_once_at_every_place() -> None:
    assert list(map(str, Recipe.parse(OLD, file="old.yaml").notices)) == NOTICES


def test_a_recipe_in_todays_words_has_no_notices() -> None:
    assert Recipe.parse(OLD.replace("push:", "press:")).notices == ()
    assert dict(Recipe.parse(OLD)) == dict(Recipe.parse(Recipe.parse(OLD).to_yaml()))


def test_only_the_new_word_is_written() -> None:
    written = Recipe.parse(OLD).to_yaml()
    assert "press: " in written
    assert "push" not in written


@pytest.mark.parametrize(
    ("written", "problem"),
    [
        ("{bubble: a, depth: 6}", "old.yaml:9:30: steps[1].push.depth: 6 cm goes through a 260, expected"),
        ("{bubble: a, depth: 0}", "old.yaml:9:30: steps[1].push.depth: 0 is out of range, expected"),
        (
            "{bubble: c, depth: 1}",
            'old.yaml:9:20: steps[1].push.bubble: unknown bubble "c", expected a',
        ),
        ("{depth: 1}", "old.yaml:9:5: steps[1].push.bubble: is missing, expected the name of a bubble"),
        (
            "{bubble: a, dept: 1, depth: 1}",
            'old.yaml:9:29: steps[1].push.dept: unknown key "dept", did you mean',
        ),
        (
            "{bubble: a, depth: *b}",
            "old.yaml:9:30: steps[1].push.depth: YAML aliases are not allowed, expected",
        ),
    ],
)
def test_problems_of_an_older_step_point_at_what_was_written(written: str, problem: str) -> None:
    (found,) = problems(OLD.replace("{bubble: a, depth: 1.5}", written))
    assert found.startswith(problem)


def test_an_older_word_beside_the_new_one_is_no_press() -> None:
    (found,) = problems(OLD.replace("    point: left", "    press: {bubble: a, depth: 1}"))
    assert found.startswith("old.yaml:10:5: steps[2].push: stands beside press, expected one operation")


def test_a_push_without_depth_and_force_is_none_of_a_finger() -> None:
    found = problems(OLD.replace("depth: 1.5", "at: 2"))
    assert "old.yaml:9:5: steps[1].push.through: is missing, expected it here" in found


@pytest.mark.parametrize(
    "steps", ["3", "[3, null]", "[{push: 3}]", "[{push: {depth: {}}}]", "{push: {depth: 1}}"]
)
def test_steps_of_any_form_are_refused_without_a_crash(steps: str) -> None:
    assert problems(f"format: 1\nname: x\nballoons: {{main: {{size: 260, tail: 10 cm}}}}\nsteps: {steps}\n")


def test_the_schema_has_no_depth_of_a_push() -> None:
    push = yaml.safe_dump(recipe_schema()["$defs"]["PushedBubble"])
    assert "depth" not in push
    assert "through" in push


def test_the_builder_pushes_bubbles_through_rings_only() -> None:
    builder = RecipeBuilder("f").balloon("main", size=260, tail=0.1)
    with pytest.raises(TypeError, match="depth"):
        builder.push("main_rest", depth=0.01)
