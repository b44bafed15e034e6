"""Petals that are gathered: one joint, one twist, and what is refused."""

from __future__ import annotations

import pytest

from balloon_usd.operations import moves
from balloon_usd.plan import plan, plan_text
from balloon_usd.recipe import Recipe, RecipeError

HEAD = """
format: 1
name: flower
units: cm
balloons:
  main: {size: 260, tail: 8}
steps:
"""
FLOWER = HEAD + "  - gather: {a: 15, b: 20, c: 15}\n    burp: 20 %\n    turns: 4\n"


@pytest.fixture(scope="module")
def flower():
    return plan(Recipe.parse(FLOWER))


def of_kind(figure, kind):
    return [move for move in figure.choreography.moves if type(move) is kind]


def test_all_ends_of_petals_are_one_joint_with_a_single_weld(flower):
    (weld,) = of_kind(flower, moves.Weld)
    assert weld.turns == 4.0
    assert weld.rings == tuple(k for k, ring in enumerate(flower.table.rings) if ring.joint)
    (joint,) = (each for each in flower.graph.joints if len(each.ends) > 1)
    assert len(joint.ends) == 7


def test_petals_are_twisted_off_first_and_then_closed_one_after_another(flower):
    twists, closings = of_kind(flower, moves.Spin), of_kind(flower, moves.Gather)
    assert len(twists) == len(closings) == 3
    assert max(move.end for move in twists) <= min(move.start for move in closings)
    assert [move.text for move in closings] == ["gather: a", "gather: b", "gather: c"]


def test_petals_are_planned_as_soft_as_the_recipe_says(flower):
    petals = flower.strips["main"].bubbles[:3]
    assert [bubble.kind for bubble in petals] == ["petal"] * 3
    assert [bubble.gas for bubble in petals] == pytest.approx([0.8] * 3)
    assert "petal" in plan_text(flower)


def test_wings_that_end_at_the_tip_of_a_balloon_are_no_petals():
    steps = HEAD + "  - rest: body\n  - gather: {a: 15, b: 15}\n"
    with pytest.raises(RecipeError, match='balloon "main" has ended'):
        Recipe.parse(steps)


@pytest.mark.parametrize(
    ("petals", "told"),
    [
        ("{a: 15}", "a is a single petal, expected loop, or at least two"),
        ("{a: 15, b: 3}", "make a ball, wider than long, with no side to bend"),
        ("{a: -1, b: 3}", "-1 cm is out of range"),
        (
            f"{{{', '.join(f'p{k}: 8' for k in range(40))}}}",
            "41 joints would be twisted into one, expected at most 32",
        ),
    ],
)
def test_what_makes_no_petals_is_refused(petals, told):
    with pytest.raises(RecipeError, match=told):
        plan(Recipe.parse(HEAD.replace("tail: 8", "length: 150, tail: 60") + f"  - gather: {petals}\n"))


def test_petals_too_short_to_bend_are_told():
    short = plan(Recipe.parse(HEAD + "  - gather: {a: 15, b: 8}\n"))
    assert any("b (8 cm) is too short for a gather" in str(caution) for caution in short.cautions)


@pytest.mark.parametrize(
    "steps",
    ["  - gather: {a: 15, b: 20, c: 15}\n    burp: 20 %\n", "  - loop: {a: 15, b: 20}\n    burp: 20 %\n"],
)
def test_petals_of_wet_rubber_are_told_to_slip_as_loops_are(steps):
    wet = plan(Recipe.parse(HEAD + steps + "physics: {friction: 0.05}\nmust_hold: none\n"))
    assert any("1 locks, loops and ears slip" in str(caution) for caution in wet.cautions)
