"""`tuck`: which limbs may be set between which others."""

from __future__ import annotations

import pytest

from balloon_usd.plan import plan, plan_text
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


def messages(steps: str) -> list[str]:
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(BIRD + steps)
    return [str(problem) for problem in caught.value.problems]


@pytest.mark.parametrize(
    ("value", "told"),
    [
        ("{bubble: nekc, between: [left_wing, right_wing]}", 'unknown bubble "nekc", did you mean "neck"?'),
        ("{bubble: neck, between: [left_wing, left_wing]}", "names a bubble twice, expected each once"),
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
    assert problem.text.startswith("knob (3 cm) has no hole, expected a loop or a fold, or two bubbles")


def test_the_plan_warns_of_a_loop_whose_wall_closes_its_hole() -> None:
    told = {}
    for n in (15, 20):
        loop = f"  - loop: {{wheel: {n}}}\n    balloon: main\n  - tuck: {{bubble: knob, between: [wheel]}}\n"
        told[n] = [each.what for each in plan(Recipe.parse(BIRD + loop)).cautions]
    assert "knob (3 cm) may slip out of wheel (15 cm)" in told[15]
    assert not any("slip out" in each for each in told[20])


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
