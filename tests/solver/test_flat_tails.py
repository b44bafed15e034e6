"""The flat tail that is measured in frames is that of the plan's budget."""

from __future__ import annotations

import pytest

from balloon_usd.operations.moves import LetGo
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.flat_tails import FlatTails
from balloon_usd.solver.performance import simulate
from balloon_usd.solver.run_summary import RunSummary

TEXT = """
format: 1
name: tails
units: cm
balloons: {{main: {{size: {size}, length: {length}, tail: {tail}}}}}
steps: [bubbles: {{one: {bubble}, two: {bubble}, three: {bubble}}}]
physics: {{model: {model}, hold: 0}}
"""


def tails_of(size, length, tail, bubble, model="latex"):
    """The plan; tails when blown up and after each twist, m; the summary of the run."""
    planned = plan(Recipe.parse(TEXT.format(size=size, length=length, tail=tail, bubble=bubble, model=model)))
    performance = simulate(planned, detail="draft", device="cpu")
    meter, summary = FlatTails(planned, performance.meshes), RunSummary(planned, performance.meshes)
    ends = {1 + round(24.0 * move.start) for move in planned.choreography.moves if isinstance(move, LetGo)}
    measured = []
    for frame in performance:
        summary.add(frame)
        if frame.time_code in ends:
            measured += meter.left(frame)
    return planned, measured, summary


@pytest.mark.parametrize(
    ("size", "length", "tail", "bubble"),
    [("260", 14, 5, 4), ("160", 12, 4, 3), ("350", 14, 5.5, 5), ("260", 20, 3.5, 8)],
)
def test_each_twist_leaves_what_the_plan_says(size, length, tail, bubble):
    planned, measured, summary = tails_of(size, length, tail, bubble)
    budget = planned.budgets["main"]
    expected = [budget.tail, *(twist.tail_left for twist in budget.twists)]
    assert measured == pytest.approx(expected, abs=1.5e-3)
    assert summary.tails_left["main"] == pytest.approx(budget.tail_left, abs=1.5e-3)


def test_what_has_no_tail_is_told_to_have_none():
    planned, measured, summary = tails_of("260", 14, 0.5, 4)
    assert planned.budgets["main"].tail_left == 0.0
    assert measured[0] == pytest.approx(5e-3, abs=1e-3)
    assert measured[1:] == [0.0, 0.0, 0.0]
    assert summary.tails_left == {"main": 0.0}


def test_the_tail_of_a_balloon_of_model_kosaka_is_what_its_plan_leaves_at_the_end():
    planned, _, summary = tails_of("260", 10, 4, 2.5, "kosaka")
    assert summary.tails_left["main"] == pytest.approx(planned.budgets["main"].tail_left, abs=3e-3)
