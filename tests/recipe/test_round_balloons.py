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
ROUND = 'takes no round balloon, and "skull" is one, expected a tube'


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
    ],
)
def test_it_is_tied_locked_aimed_and_squeezed(step):
    before = "" if "left_arm" in step else "  - tie: {end: head.start, to: left_arm.start}\n"
    Recipe.parse(f"{HEAD}{before}  - {step}\n")


@pytest.mark.parametrize(
    ("step", "key"),
    [
        ("loop: {a: 9}\n    balloon: skull", "loop"),
        ("ear: {a: 3}\n    balloon: skull", "ear"),
        ("bend: {head: 90}", "bend"),
        ("curl: {head: 2}", "curl"),
        ("pop: head", "pop"),
        ("press: {bubble: head, depth: 1}", "press"),
        ("thread: {bubble: head, through: [left_arm, right_arm]}", "thread"),
    ],
)
def test_what_takes_no_round_balloon_is_refused_with_one_complaint(step, key):
    (told,) = problems(f"{HEAD}  - {step}\n")
    assert told.endswith(f": {ROUND}")
    assert f"steps[3].{key}" in told


def test_it_has_no_flat_tip():
    told = problems(f"{HEAD}  - tie: {{end: head.end, to: left_arm.start}}\n")
    assert told == [
        "<text>:13:16: steps[3].tie.end: head is a round balloon, which has no flat tip, "
        "expected head.start, its nozzle"
    ]


def test_its_far_side_is_no_joint():
    for step in ("tie: {end: left_arm.start, to: head.end}", "lock: {joints: [left_arm.start, head.end]}"):
        (told,) = problems(f"{HEAD}  - {step}\n")
        assert told.endswith("head.end is the far side of a round balloon, expected head.start, its nozzle")


def test_bubbles_of_a_tube_and_a_round_one_are_locked_by_joints():
    (told,) = problems(f"{HEAD}  - lock: [left_arm, head]\n")
    assert told.endswith("expected lock: {joints: [left_arm.start, head.start]}")


def test_a_balloon_named_where_a_bubble_belongs_is_told_how_its_bubble_gets_a_name():
    (told,) = problems(f"{HEAD}  - tie: {{end: skull.start, to: left_arm.start}}\n")
    assert told.endswith(
        '"skull" is a balloon, expected the name of a bubble of it, such as {rest: NAME, balloon: skull} gives'
    )


def test_what_takes_no_round_one_is_not_offered_it():
    (told,) = problems(HEAD + "  - loop: {more: 25}\n")
    assert told.endswith("does not say on which balloon, expected balloon: body")
    (told,) = problems(HEAD + "  - bubbles: {more: 5}\n")
    assert told.endswith("does not say on which balloon, expected balloon: one of body, skull")


def test_nothing_is_twisted_off_one_behind_its_rest():
    (told,) = problems(HEAD + "  - bubbles: {more: 5}\n    balloon: skull\n")
    assert told.endswith(
        'balloon "skull" has ended at steps[0].rest, expected nothing made of it after its rest'
    )


def test_a_joint_at_which_one_is_twisted_is_locked_but_not_its_far_side():
    twisted = HEAD.replace("  - rest: head", "  - bubbles: {neck: 5}\n    balloon: skull\n  - rest: head")
    Recipe.parse(f"{twisted}  - lock: {{joints: [left_arm.start, neck.end]}}\n")
    (told,) = problems(f"{twisted}  - lock: {{joints: [left_arm.start, head.end]}}\n")
    assert told.endswith("head.end is the far side of a round balloon, expected head.start")


def test_a_heart_is_not_twisted():
    heart = HEAD.replace("R5", "H6").replace("rest: head", "bubbles: {lobe: 4}")
    (told,) = problems(heart)
    assert told.endswith('bubbles: takes no heart, and "skull" is one, expected a tube or a round balloon')


def test_a_size_in_small_letters_is_one_fault():
    assert len(problems(HEAD.replace("R5", "r5"))) == 1


@pytest.mark.parametrize("key", ["tail: 3", "length: 4", "capsule: 9", "swell: 2"])
def test_keys_of_other_balloons_are_refused(key):
    (told,) = problems(HEAD.replace("size: R5", f"size: R5, {key}"))
    assert f"balloons.skull.{key.split(':')[0]}: makes no sense with" in told


def test_springs_and_air_particles_do_not_blow_it_up():
    told = problems(HEAD + "physics: {model: kosaka}\n")
    assert any("balloons.skull.size: makes no sense with model kosaka" in each for each in told)


def test_the_builder_writes_what_is_read():
    builder = RecipeBuilder("ball", units="cm")
    builder.balloon("b", size="R5", inflated=0.08).add("rest", "ball", balloon="b")
    recipe = builder.build()
    assert "{size: R5, inflated: 8}" in recipe.to_yaml()
    assert Recipe.parse(recipe.to_yaml()).balloons["b"].inflated == pytest.approx(0.08)


def test_a_tube_is_not_overblown():
    (told,) = problems(HEAD.replace("tail: 12", "tail: 12, overblown: 30"))
    assert told == (
        "<text>:5:42: balloons.body.overblown: makes no sense with a tube, whose short bubbles softened "
        "rubber does not hold, expected a round balloon, or no such line"
    )


def test_overblow_is_no_step_and_where_it_is_said_is_told():
    (told,) = problems(f"{HEAD}  - overblow: skull\n")
    assert told.endswith(
        "blowing up too far, and letting air out again, expected overblown: of a round balloon"
    )


def test_what_one_is_overblown_to_is_built_and_written():
    builder = RecipeBuilder("ball", units="cm").balloon("ball", size="R5", inflated=0.09, overblown=0.12)
    recipe = builder.rest("whole", balloon="ball").build()
    assert recipe.balloons["ball"].overblown == 0.12
    assert "overblown: 12" in recipe.to_yaml()
    assert Recipe.parse(recipe.to_yaml()).balloons["ball"].overblown == 0.12
