"""`tuck`: which limbs may be set between which others."""

from __future__ import annotations

import pytest

from balloon_usd.plan import plan, plan_text
from balloon_usd.plan.twins import twins_of
from balloon_usd.recipe import Recipe, RecipeError

BIRD = """
format: 1
name: bird
units: cm
balloons:
  main: {size: 260, length: 24, tail: 8}
  other: {size: 260, length: 12, tail: 4}
steps:
  - bubbles: {head: 5, neck: 13, left_wing: 12, right_wing: 12}
    balloon: main
  - lock: [left_wing, right_wing]
  - ear: {knob: 3}
    balloon: main
  - bubbles: {egg: 5}
    balloon: other
"""
HEAD = BIRD[: BIRD.index("steps:")]


def on_main(steps: list[str]) -> str:
    """Write steps, of which those that make bubbles do so on the first of the two balloons."""
    makes = ("bubbles", "ear", "loop")
    return "".join(f"  - {each}\n" + "    balloon: main\n" * each.startswith(makes) for each in steps)


def messages(steps: str) -> list[str]:
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(BIRD + steps)
    return [str(problem) for problem in caught.value.problems]


@pytest.mark.parametrize(
    ("value", "told"),
    [
        ("{bubble: nekc, between: [left_wing, right_wing]}", 'unknown bubble "nekc", did you mean "neck"?'),
        (
            "{bubble: neck, between: [left_wing, left_wing]}",
            "names a bubble twice, expected each once",
        ),
        ("{bubble: neck, between: [neck, left_wing]}", "names a bubble twice, expected each once"),
        ("{bubble: neck, between: [left_wing]}", "left_wing is no closed ring by now, expected a loop"),
        ("{bubble: neck, between: [left_wing, right_wing, knob]}", "between"),
        ("{bubble: neck, between: []}", "between: is empty"),
        ("{bubble: neck}", "between"),
        ("neck", "tuck"),
        ("{bubble: egg, between: [left_wing, right_wing]}", "left_wing and right_wing are on another figure"),
        ("{bubble: neck, between: [egg, right_wing]}", "egg is on another figure than neck"),
        ("{bubble: neck, between: [head, left_wing]}", "head hangs on neck and would be turned with it"),
        ("{bubble: left_wing, between: [right_wing, knob]}", "right_wing hangs on left_wing and would be"),
    ],
)
def test_a_limb_goes_only_between_others_of_its_figure(value: str, told: str) -> None:
    found = messages(f"  - tuck: {value}\n")
    assert any(told in each for each in found), found


@pytest.mark.parametrize("before", ["tuck: {bubble: knob, between: [neck, left_wing]}", "pop: knob"])
def test_what_is_held_or_popped_already_is_not_tucked(before: str) -> None:
    found = messages(f"  - {before}\n  - tuck: {{bubble: knob, between: [left_wing, right_wing]}}\n")
    assert any("held by others already" in each or "was popped" in each for each in found), found


def test_a_ball_that_closes_on_itself_has_no_hole_for_a_limb() -> None:
    recipe = Recipe.parse(BIRD + "  - tuck: {bubble: neck, between: [knob]}\n")
    with pytest.raises(RecipeError) as caught:
        plan(recipe)
    (problem,) = caught.value.problems
    assert problem.text.startswith("knob (3 cm) has no hole, expected a loop, or two bubbles")


def test_the_plan_warns_of_a_loop_whose_wall_closes_its_hole_and_of_one_whose_hole_is_too_wide() -> None:
    told, bird = {}, BIRD.replace("length: 24", "length: 30")
    for n in (15, 20, 30, 32):
        loop = f"  - loop: {{wheel: {n}}}\n    balloon: main\n  - tuck: {{bubble: knob, between: [wheel]}}\n"
        told[n] = [each.what for each in plan(Recipe.parse(bird + loop)).cautions]
    assert "knob (3 cm) may slip out of wheel (15 cm)" in told[15]
    assert not any("slip out" in each for each in (*told[20], *told[30]))
    assert "knob may slip out of wheel (32 cm)" in told[32]


SWAN = """
format: 1
name: swan
units: cm
balloons:
  main: {size: 260, length: 30, tail: 6}
steps:
  - gather: {small: 20, large: SIZE}
  - rest: neck
  - tuck: {bubble: small, between: [large]}
"""


def test_the_plan_warns_of_a_loop_that_is_as_wide_as_two_tubes_and_of_no_hole_as_wide_as_one() -> None:
    told = {size: str(plan(Recipe.parse(SWAN.replace("SIZE", str(size)))).cautions) for size in (26, 30, 50)}
    assert "small (20 cm) may not come into large (26 cm)" in told[26]
    assert "make large at least 30 cm long, or small at most 17.3 cm" in told[26]
    assert "small" not in told[30] + told[50]


def test_nothing_is_set_into_a_fold() -> None:
    fold = "  - fold: {wheel: 20}\n    balloon: main\n  - tuck: {bubble: knob, between: [wheel]}\n"
    with pytest.raises(RecipeError, match="wheel is a fold, whose halves its twist keeps side by side"):
        plan(Recipe.parse(BIRD + fold))


def test_the_twist_by_which_it_hangs_holds_and_what_hangs_on_it_may_turn() -> None:
    bird = BIRD.split("  - bubbles: {egg", maxsplit=1)[0].replace(
        "  other: {size: 260, length: 12, tail: 4}\n", ""
    )
    loose = {}
    for name in ("", "neck", "head"):
        step = f"  - tuck: {{bubble: {name}, between: [left_wing, right_wing]}}\n" if name else ""
        made = plan(Recipe.parse(bird + step))
        loose[name] = {str(each.end) for each in made.loose}
    assert loose == {"": {"head.end"}, "neck": {"head.end"}, "head": set()}
    assert "step 4 tucks head between left_wing, right_wing, which hold it" in plan_text(made)


def test_of_several_joints_the_limb_turns_about_the_one_that_leaves_the_others_behind() -> None:
    steps = [
        "bubbles: {head: 5, a: 6, b: 6, neck: 8, left_wing: 12, right_wing: 12}",
        "lock: [left_wing, right_wing]",
        "tuck: {bubble: neck, between: [left_wing, right_wing]}",
    ]
    recipe = Recipe.parse(HEAD + "steps:\n" + on_main(steps))
    limb = recipe.piece.limb("neck", ["left_wing", "right_wing"])
    assert limb is not None
    assert limb.bubbles == {"head", "a", "b", "neck"}


@pytest.mark.parametrize(("tucked", "others"), [("e", "[a, b]"), ("a", "[d, e]")])
def test_bubbles_between_a_limb_and_what_holds_it_do_not_unwind_either_way_round(
    tucked: str, others: str
) -> None:
    steps = [
        "bubbles: {a: 8, b: 8, c: 8, d: 8, e: 8}",
        "ear: {z: 3}",
        f"tuck: {{bubble: {tucked}, between: {others}}}",
    ]
    text = HEAD.replace("length: 24", "length: 34") + "steps:\n" + on_main(steps)
    found = {str(each.end) for each in plan(Recipe.parse(text)).loose}
    assert found == ({"a.end"} if tucked == "e" else {"d.end"})


def test_a_loop_that_slips_holds_nothing_and_one_that_is_popped_frees_what_it_held() -> None:
    loop = "loop: {wheel: 20}\n    turns: 1"
    steps = ["bubbles: {hub: 6}", loop, "ear: {end: 3}", "tuck: {bubble: hub, between: [wheel]}"]
    text = HEAD + "steps:\n" + on_main(steps)
    assert {str(each.end) for each in plan(Recipe.parse(text)).loose} == {"hub.end"}
    popped = text.replace("\n    turns: 1", "") + on_main(
        ["pop: wheel", "tuck: {bubble: hub, between: [end]}"]
    )
    with pytest.raises(RecipeError, match=r"end .*has no hole"):
        plan(Recipe.parse(popped))


def test_two_loops_do_not_lie_in_each_other() -> None:
    loops = "bubbles: {a: 5}", "loop: {one: 20}", "ear: {knob: 3}", "loop: {two: 24}"
    tucks = "tuck: {bubble: one, between: [two]}", "tuck: {bubble: two, between: [one]}"
    with pytest.raises(RecipeError, match="one cannot hold two, which holds one"):
        Recipe.parse(HEAD + "steps:\n" + on_main([*loops, *tucks]))


def test_a_pair_of_legs_that_goes_in_edgewise_has_no_twins_and_those_that_hold_it_are_some() -> None:
    steps = [
        "bubbles: {neck: 5, left_foreleg: 10, right_foreleg: 10}",
        "lock: [left_foreleg, right_foreleg]",
        "bubbles: {body: 7, left_hindleg: 10, right_hindleg: 10}",
        "lock: [left_hindleg, right_hindleg]",
    ]
    text = HEAD.replace("length: 24", "length: 30") + "steps:\n" + on_main(steps)
    tuck = on_main(["tuck: {bubble: left_foreleg, between: [left_hindleg, right_hindleg]}"])
    found = []
    for recipe in (Recipe.parse(text), Recipe.parse(text + tuck)):
        strips = plan(recipe).strips
        found.append([left.name for left, _ in twins_of(recipe, strips)])
    assert found == [["left_foreleg", "left_hindleg"], ["left_hindleg"]]


@pytest.mark.parametrize(
    ("aimed", "told"),
    [
        ("neck", "neck would take neck away from left_wing and right_wing, which hold it"),
        ("left_wing", "left_wing would take neck away from left_wing and right_wing, which hold it"),
        ("head", None),
    ],
)
def test_what_is_tucked_is_not_aimed_away_nor_what_holds_it(aimed: str, told: str | None) -> None:
    steps = f"  - tuck: {{bubble: neck, between: [left_wing, right_wing]}}\n  - aim: {{{aimed}: up}}\n"
    if told is None:
        assert Recipe.parse(BIRD + steps).steps
    else:
        assert any(told in each for each in messages(steps))
