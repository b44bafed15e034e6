"""Balloons that are blown up to a share of their length, or of their width."""

from __future__ import annotations

import pytest

from balloon_usd.plan import plan as plan_of
from balloon_usd.plan.filling import emptier, fuller
from balloon_usd.recipe import Recipe, RecipeBuilder, RecipeError

TUBE = """
format: 1
name: tube
units: cm
balloons:
  main: {{size: 260, {filling}}}
steps:
  - bubbles: {{{bubbles}}}
  - rest: end
"""
MANY = ", ".join(f"b{k}: 4" for k in range(9))


def tube(filling, bubbles="head: 10"):
    return plan_of(Recipe.parse(TUBE.format(filling=filling, bubbles=bubbles)))


def test_three_quarters_of_a_tube_leave_a_quarter_of_it_flat():
    made = tube("filled: 75 %")
    assert made.strips["main"].tail == pytest.approx(0.25 * 0.367)
    assert made.budgets["main"].inflated_length == pytest.approx(0.75 * made.strips["main"].full_length)


def test_a_share_is_the_same_as_the_tail_that_it_leaves():
    shares, tails = (tube(filling).strips["main"].bubbles for filling in ("filled: 80", "tail: 7.34"))
    assert [each.volume for each in shares] == pytest.approx([each.volume for each in tails])


def test_a_round_balloon_is_blown_up_to_a_share_of_its_width():
    text = (
        "format: 1\nname: ball\nunits: cm\nballoons: {b: {size: R11, filled: 75 %}}\nsteps: [{rest: ball}]\n"
    )
    assert plan_of(Recipe.parse(text)).strips["b"].inflated_radius == pytest.approx(0.105)


def test_a_round_balloon_that_is_filled_too_little_is_refused_at_its_share():
    text = "format: 1\nname: ball\nunits: cm\nballoons: {b: {size: R5, filled: 10}}\nsteps: [{rest: ball}]\n"
    with pytest.raises(
        RecipeError, match=r"balloons\.b\.filled: a round balloon .* expected a width of 3\.4 cm"
    ):
        plan_of(Recipe.parse(text))


def test_bubbles_that_do_not_fit_ask_for_a_larger_share():
    with pytest.raises(RecipeError, match=r"does not fit: .*, expected filled: at least 14 %"):
        tube("filled: 8", "head: 20")
    tube("filled: 14", "head: 20")


def test_twists_that_use_up_the_tail_ask_for_a_smaller_share():
    told = [[each.remedy for each in tube(f"filled: {share}", MANY).cautions] for share in (98, 77)]
    assert ["write filled: at most 77 %" in remedies for remedies in told] == [True, False]


def test_a_share_that_leaves_no_bubble_is_refused_with_the_least_that_does():
    with pytest.raises(
        RecipeError, match=r"balloons\.main\.filled: a tail of 36\.3 cm leaves nothing of a 260"
    ):
        tube("filled: 1")


@pytest.mark.parametrize("key", ["tail: 3", "inflated: 90"])
def test_it_stands_beside_no_other_way_to_say_it(key):
    with pytest.raises(RecipeError, match="expected exactly one of tail, inflated, filled, capsule"):
        tube(f"filled: 75, {key}")


def test_it_is_written_back_as_it_was():
    builder = RecipeBuilder("tube", units="cm")
    builder.balloon("main", size=260, filled="75 %").bubbles(head=0.1)
    recipe = builder.build()
    assert "filled: 75" in recipe.to_yaml()
    assert Recipe.parse(recipe.to_yaml()).balloons["main"].filled == pytest.approx(75.0)


@pytest.mark.parametrize(
    ("filling", "more", "less"),
    [
        ("tail: 9", "a tail of at most 5 cm", "leave a tail of at least 5 cm"),
        ("filled: 75", "filled: at least 87 %", "write filled: at most 86 %"),
        ("inflated: 90", "inflated: at least 131.5 cm", "write inflated: at most 131.4 cm"),
    ],
)
def test_advice_is_given_in_the_words_of_the_recipe(filling, more, less):
    made = tube(filling)
    of = made.recipe.balloons["main"], made.strips["main"].size, made.strips["main"].rubber
    assert (fuller(*of, 0.05), emptier(*of, 0.05)) == (more, less)
