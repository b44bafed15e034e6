"""The plan tells at which twist a tube bursts, and calls nothing that is made daily a burst."""

from __future__ import annotations

from pathlib import Path

import pytest

from balloon_usd.plan import plan
from balloon_usd.plan.wall_load import wall_loads
from balloon_usd.recipe import Recipe

RECIPES = Path(__file__).parents[2] / "recipes"
MADE = sorted([*RECIPES.glob("book/*.yaml"), *RECIPES.glob("*.yaml")])
HEAD = "format: 1\nname: figure\nunits: cm\n"


def loads_of(figure):
    return [load for name, it in figure.budgets.items() for load in loads_on(figure, name, it)]


def loads_on(figure, name, budget):
    return list(wall_loads(figure.strips[name], budget, figure.graph))


def bursts(figure):
    return [caution.what for caution in figure.cautions if "burst" in caution.what]


@pytest.mark.parametrize("path", MADE, ids=lambda path: path.stem)
def test_no_figure_that_is_made_daily_may_burst(path):
    figure = plan(Recipe.load(path))
    assert bursts(figure) == []
    # Only tubes have a load, and one of the figures has none.
    assert max(loads_of(figure), default=0.0) < 1.0


def chain(tail, kind="bubbles", count=24, length=3):
    bubbles = ", ".join(f"b{k}: {length}" for k in range(count))
    steps = f"steps: [{kind}: {{{bubbles}}}]\n"
    return plan(Recipe.parse(f"{HEAD}balloons: {{main: {{size: 260, tail: {tail}}}}}\n{steps}"))


def test_a_chain_without_tail_bursts_about_where_the_tube_is_stretched_to_seven():
    figure = chain(0)
    (what,) = bursts(figure)
    (twist,) = [t for t in figure.budgets["main"].twists if what.endswith(f" {t.bubble}")]
    assert 7.0 < twist.hoop_stretch < 7.4
    assert 8.8e3 < twist.pressure < 9.4e3


def test_with_a_tail_the_same_chain_does_not():
    assert bursts(chain(25)) == []


def test_loads_only_rise_while_a_tube_is_twisted_off():
    loads = loads_of(chain(0))
    assert loads == sorted(loads)


def test_loops_that_a_long_balloon_bears_burst_a_balloon_without_tail():
    full = HEAD + "balloons: {main: {size: 260, length: 6, tail: %s}}\nsteps: [{loop: {head: 12}}]\n"
    assert bursts(plan(Recipe.parse(full % 2))) == []
    assert bursts(plan(Recipe.parse(full % 0))) == ["main may burst at the twist that ends head"]


def test_a_loop_out_of_which_gas_is_pressed_bursts_no_balloon_and_fills_its_tail():
    text = HEAD + "balloons: {main: {size: 260, length: 8, tail: %s}}\nsteps: [{loop: {head: 12}%s}]\n"
    assert bursts(plan(Recipe.parse(text % (0, "")))) != []
    assert bursts(plan(Recipe.parse(text % (0, ", burp: 30")))) == []
    (hard,), (soft,) = (
        plan(Recipe.parse(text % (3, burp))).budgets["main"].twists for burp in ("", ", burp: 30")
    )
    assert soft.tail_left < hard.tail_left


def test_a_dog_without_tail_is_told_to_be_hard():
    text = (RECIPES / "dog.yaml").read_text().replace("tail: 10", "tail: 0")
    figure = plan(Recipe.parse(text))
    (caution,) = figure.cautions
    assert caution.what == "main runs out of tail at the twist that ends nose"
    assert caution.why.endswith("each makes what is left harder, up to 7.9 kPa from 7.1 kPa")
