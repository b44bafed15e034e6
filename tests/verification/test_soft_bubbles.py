"""V33: bubbles that hands press gas out of keep what is left, and bear it more easily."""

from __future__ import annotations

from functools import cache

import pytest

from balloon_usd.plan import plan
from balloon_usd.plan.wall_load import wall_loads
from balloon_usd.recipe import Recipe
from balloon_usd.solver.run_summary import RunSummary
from balloon_usd.solver.simulation import simulate_many

LOOP = """
format: 1
name: soft
units: cm
balloons:
  main: {size: 260, length: 36, tail: 6}
steps:
  - bubbles: {before: 9}
  - loop: {it: 12}
    BURP
  - rest: beyond
physics: {hold: 0.5}
"""
"""A loop that makers press air out of before they bend it."""
STRAIGHT = LOOP.replace("loop: {it: 12}", "bubbles: {it: 8}")
BALL = LOOP.replace("loop: {it: 12}", "bubbles: {it: 2}")


class Made:
    """A finished figure, in the last frame before hands loosen their grip."""

    def __init__(self, text: str, burp: float) -> None:
        manner = f"burp: {burp:g} %" if burp else "note: as full as the tube"
        self.plan = plan(Recipe.parse(text.replace("BURP", manner)))
        simulation = simulate_many([self.plan], detail="draft", device="cpu")
        summary = RunSummary(self.plan, simulation.meshes[0])
        for (frame,) in simulation.frames():
            if frame.doing.startswith("loosen"):
                break
            summary.add(frame)
            last = frame
        self.load = summary.wall_load.load
        self.pressure = float(last.pressure[1])
        model = simulation.model
        self.gas = float(model.scene.amount.numpy()[model.layout.bubbles[1]])

    @property
    def planned_load(self) -> float:
        """Load of the walls in the plan."""
        return max(wall_loads(self.plan.strips["main"], self.plan.budgets["main"], self.plan.graph))


@cache
def made(text: str, burp: float) -> Made:
    return Made(text, burp)


@pytest.mark.parametrize("burp", [20, 40])
@pytest.mark.parametrize("text", [LOOP, STRAIGHT], ids=["loop", "straight"])
def test_a_soft_bubble_keeps_the_share_of_gas_that_is_not_pressed_out(verify, text, burp):
    what = "loop" if text == LOOP else "straight bubble"
    kept = made(text, burp).gas / made(text, 0).gas
    verify("V33", f"{what}, {burp} % pressed out, gas left", kept, 1.0 - 0.01 * burp, 1e-6)


@pytest.mark.parametrize("burp", [0, 20, 40])
def test_the_plan_knows_how_much_less_a_soft_loop_bears(verify, burp):
    loop = made(LOOP, burp)
    verify("V33", f"loop, {burp} % pressed out, load in the plan", loop.planned_load, loop.load, 5e-2)


def test_a_ball_is_the_harder_the_smaller_it_gets(verify):
    pressures = [made(BALL, burp).pressure for burp in (0, 20, 50)]
    assert pressures == sorted(pressures)
    verify("V33", "ball, 50 % pressed out, gas left", made(BALL, 50).gas / made(BALL, 0).gas, 0.5, 1e-6)


def test_a_soft_bubble_is_soft():
    for text in (LOOP, STRAIGHT):
        pressures = [made(text, burp).pressure for burp in (0, 20, 40)]
        assert pressures == sorted(pressures, reverse=True)
    assert made(STRAIGHT, 40).pressure < 5.0e3
    assert made(LOOP, 40).pressure < 0.85 * made(LOOP, 0).pressure
    assert made(LOOP, 20).load < 0.65
