"""Budgets: tail and gas."""

from __future__ import annotations

from itertools import pairwise

import pytest

from balloon_usd.balloon.bubble_shape import tail_volume_per_rest_length, tube_volume_per_rest_length
from balloon_usd.balloon.wound_neck import drawn_rubber
from balloon_usd.plan import plan_text
from balloon_usd.plan.open_tube import softened


def test_the_thesis_dog_keeps_17_millimetres_of_its_tail(dog):
    budget = dog.budgets["main"]
    assert len(budget.twists) == 9
    assert budget.tail_left == pytest.approx(0.017, abs=0.5e-3)
    assert budget.tail_used == pytest.approx(9 * budget.cost_per_twist, rel=1e-3)
    assert budget.runs_out is None


def test_the_tail_shrinks_by_about_nine_millimetres_with_every_twist(dog):
    budget = dog.budgets["main"]
    tails = [budget.tail, *(twist.tail_left for twist in budget.twists)]
    steps = [before - after for before, after in pairwise(tails)]
    assert steps == pytest.approx([9.2e-3] * 9, abs=0.1e-3)


def test_the_gas_of_a_full_260_is_an_eighth_of_a_mole(planned):
    budget = planned("balloons: {a: {size: 260, tail: 0}}\nsteps: [{bubbles: {c: 6}}]").budgets["a"]
    assert budget.gas_amount == pytest.approx(0.138, rel=0.015)
    assert budget.volume == pytest.approx(3.1e-3, rel=0.015)
    assert budget.pressure == pytest.approx(7134.5, rel=1e-4)


def test_a_short_tail_runs_out_at_the_twist_that_exceeds_it(planned):
    budget = planned("""
        balloons: {a: {size: 260, tail: 2.5}}
        steps: [{bubbles: {b: 10, c: 10}}, {bubbles: {d: 10, e: 10}}]
        """).budgets["a"]
    assert (budget.runs_out.bubble, budget.runs_out.step) == ("d", 1)
    assert budget.twists[-1].pressure > budget.pressure
    assert budget.twists[0].pressure == pytest.approx(budget.pressure)


def test_inflation_between_its_bounds_comes_out_with_tail_and_gas(planned, dog):
    budget = dog.budgets["main"]
    assert budget.shortest_inflation < budget.inflated_length < budget.longest_inflation
    assert budget.tail_needed == pytest.approx(budget.tail_used)
    body = "balloons: {{a: {{size: 260, inflated: {}}}}}\nsteps: [{{bubbles: {{b: 20, c: 20, d: 20}}}}]"
    room = planned(body.format(100)).budgets["a"]
    least, most = room.shortest_inflation * 100.0, room.longest_inflation * 100.0
    assert planned(body.format(least + 0.1)).budgets["a"].runs_out is None
    assert planned(body.format(most - 0.1)).budgets["a"].runs_out is None
    assert planned(body.format(most + 0.5)).budgets["a"].runs_out.bubble == "d"


WOUND = """
balloons: {{a: {{size: 260, tail: 12}}}}
steps: [{{bubbles: {{b: 10, c: 10, d: 2}}, turns: {}}}]
"""


def test_every_turn_beyond_the_third_fills_as_much_tail_as_the_rubber_that_it_draws_in(planned):
    few, many = (planned(WOUND.format(turns)) for turns in (3, 8))
    strip, (before, after) = many.strips["a"], (each.budgets["a"] for each in (few, many))
    size, rubber = strip.size, softened(strip.rubber)
    drawn = 3.0 * drawn_rubber(size, rubber, 8.0)
    bulged, thin = tube_volume_per_rest_length(size, rubber), tail_volume_per_rest_length(size, rubber)
    assert (before.drawn, after.drawn) == (0.0, pytest.approx(drawn))
    assert after.tail_used - before.tail_used == pytest.approx(drawn * bulged / (bulged - thin), rel=1e-6)
    assert after.tail_needed == pytest.approx(after.tail_used)
    assert "and 1.6 cm that turns draw in" in plan_text(many)
    assert "draw in" not in plan_text(few)


def test_necks_take_their_rubber_half_from_each_side_and_bubbles_keep_theirs(planned):
    few, many = (planned(WOUND.format(turns)).strips["a"] for turns in (3, 8))
    each = drawn_rubber(many.size, softened(many.rubber), 8.0)
    assert [bubble.drawn for bubble in many.bubbles] == [(0.0, each), (each, each), (each, each), (each, 0.0)]
    for before, after in zip(few.bubbles[:-1], many.bubbles[:-1], strict=True):
        assert after.wall_length == pytest.approx(before.rest_length)
        assert after.volume == pytest.approx(before.volume)
    assert sum(bubble.wall_length for bubble in many.bubbles) + 3.0 * each == pytest.approx(many.size.length)


def test_a_balloon_without_wound_necks_loses_nothing_to_turns(planned):
    text = (
        "physics: {model: kosaka}\nballoons: {a: {size: 260, tail: 12}}\nsteps: [{bubbles: {b: 10, c: 10}}]"
    )
    assert planned(text).budgets["a"].drawn == 0.0
