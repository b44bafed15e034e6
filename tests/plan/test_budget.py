"""Budgets: tail and gas."""

from __future__ import annotations

from itertools import pairwise

import pytest


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
