"""What goes with round balloons, and what does not."""

from __future__ import annotations

import pytest

from balloon_usd.recipe import Recipe, RecipeBuilder, RecipeError

HEAD = """\
format: 1
name: man
units: cm
balloons:
  body: {size: 260, tail: 12}
  skull: {size: R5}
steps:
  - rest: head
    balloon: skull
  - bubbles: {left_arm: 14, right_arm: 14}
    balloon: body
  - lock: [left_arm, right_arm]
"""
ROUND = 'balloon "skull" is round, one bubble that is neither twisted nor bent, expected a tube'


def problems(text):
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(text)
    return [str(problem) for problem in caught.value.problems]


@pytest.mark.parametrize(
    "step",
    [
        "tie: {end: head.start, to: left_arm.start}",
        "lock: {joints: [head.start, left_arm.start]}",
        "aim: {head: up}",
        "squeeze: {bubble: head, by: 20 %}",
        "press: {bubble: head, depth: 1}",
    ],
)
def test_it_is_tied_locked_aimed_and_pressed(step):
    before = "" if "left_arm" in step else "  - tie: {end: head.start, to: left_arm.start}\n"
    Recipe.parse(f"{HEAD}{before}  - {step}\n")


@pytest.mark.parametrize(
    ("step", "key"),
    [
        ("bubbles: {a: 5}\n    balloon: skull", "bubbles"),
        ("ear: {a: 3}\n    balloon: skull", "ear"),
        ("bend: {head: 90}", "bend"),
        ("curl: {head: 2}", "curl"),
        ("pop: head", "pop"),
        ("thread: {bubble: head, through: [left_arm, right_arm]}", "thread"),
    ],
)
def test_it_is_neither_twisted_nor_bent(step, key):
    assert any(each.endswith(f"steps[3].{key}: {ROUND}") for each in problems(f"{HEAD}  - {step}\n"))


def test_it_has_no_flat_tip():
    told = problems(f"{HEAD}  - tie: {{end: head.end, to: left_arm.start}}\n")
    assert told == [
        "<text>:13:16: steps[3].tie.end: head is a round balloon, which has no flat tip, "
        "expected head.start, its nozzle"
    ]


@pytest.mark.parametrize("key", ["tail: 3", "length: 4", "capsule: 9", "swell: 2"])
def test_keys_of_other_balloons_are_refused(key):
    told = problems(HEAD.replace("size: R5", f"size: R5, {key}"))
    assert any(f"balloons.skull.{key.split(':')[0]}: makes no sense with" in each for each in told), told


def test_nothing_is_put_into_it_and_it_is_put_into_nothing():
    text = """
format: 1
name: egg
units: cm
balloons:
  egg: {size: R11, finish: clear}
  bird: {size: R5, inflated: 6}
steps:
  - insert: {bird: shell}
  - inflate: egg
  - inflate: bird
  - {rest: shell, balloon: egg}
"""
    told = problems(text)
    assert [each.split(": ", 2)[2] for each in told] == [
        'balloon "bird" is round, expected tubes, or meshes, alone',
        'balloon "egg" is round, expected tubes, or meshes, alone',
    ]


def test_springs_and_air_particles_do_not_blow_it_up():
    told = problems(HEAD + "physics: {model: kosaka}\n")
    assert any("balloons.skull.size: makes no sense with model kosaka" in each for each in told)


def test_the_builder_writes_what_is_read():
    builder = RecipeBuilder("ball", units="cm")
    builder.balloon("b", size="R5", inflated=0.08).add("rest", "ball", balloon="b")
    recipe = builder.build()
    assert "{size: R5, inflated: 8}" in recipe.to_yaml()
    assert Recipe.parse(recipe.to_yaml()).balloons["b"].inflated == pytest.approx(0.08)
