"""A balloon that is blown up by a step of its own, beside one that is twisted before."""

from __future__ import annotations

import re

import numpy as np
import pytest

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.operations.moves import PUSHING, Inflate
from balloon_usd.plan import choreography, plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.performance import simulate

HEAD = "format: 1\nname: figure\nunits: cm\n"
TWO = (
    HEAD
    + """balloons:
  first: {size: 260, color: red, length: 11, tail: 4}
  second: {size: 350, color: blue, length: 9, inflated: 16}
steps:
  - bubbles: {nose: 4, left: 6, right: 6}
    balloon: first
  - lock: [left, right]
  - inflate: second
    seconds: 1.2
  - bubbles: {hat: 6}
    balloon: second
  - lock: {joints: [nose.end, hat.end]}
physics: {hold: 0}
"""
)
STILL = 1.5
"""Time in which flat rubber comes to rest round its knot, s."""


@pytest.fixture(scope="module")
def planned():
    return plan(Recipe.parse(TWO))


@pytest.fixture(scope="module")
def frames(planned):
    return [
        (
            index / planned.recipe.fps,
            frame.points[1].copy(),
            frame.stretch[1].max(),
            frame.pressure.copy(),
            frame.undone,
        )
        for index, frame in enumerate(simulate(planned, detail="draft", device="cpu"))
    ]


@pytest.fixture(scope="module")
def pump(planned):
    return next(
        move for move in planned.choreography.moves if isinstance(move, Inflate) and move.balloon == "second"
    )


def test_a_flat_balloon_lies_still_while_the_other_is_blown_up_twisted_and_locked(frames, pump):
    before = [points for time, points, *_ in frames if STILL < time < pump.start]
    assert len(before) > 80
    assert max(np.abs(points - before[0]).max() for points in before) < 0.1e-3
    assert max(stretch for time, _, stretch, *_ in frames if STILL < time < pump.start) < 1.3


def test_it_then_has_its_length_and_its_pressure(frames, planned, pump):
    budget = planned.budgets["second"]
    points, pressure = next((p, gas) for time, p, _, gas, _ in frames if time > pump.end + 0.3)
    wide = np.ptp(points[:, 1])
    assert wide == pytest.approx(2.0 * planned.strips["second"].inflated_radius, rel=0.04)
    assert pressure[-1] == pytest.approx(budget.pressure, rel=0.06)


def test_what_is_made_of_it_holds(frames, planned):
    assert planned.cautions == ()
    assert frames[-1][-1] == ()


STROKES = (
    HEAD
    + """balloons: {one: {size: 350, length: 9, inflated: 16}}
steps:
  - inflate: one
    strokes: 4
  - wait: 1
physics: {hold: 0}
"""
)


def test_every_stroke_of_a_hand_pump_brings_as_much_and_none_flows_back_between_them():
    made = plan(Recipe.parse(STROKES))
    move = next(move for move in made.choreography.moves if isinstance(move, Inflate))
    gas = np.array(
        [
            float(((ATMOSPHERE + frame.pressure) * frame.volume).sum())
            for frame in simulate(made, device="cpu")
        ]
    )
    frames = made.recipe.fps * (move.start + move.seconds * np.arange(5) / 4.0)
    after = gas[np.round(frames).astype(int)]
    assert np.diff(after) == pytest.approx((gas[-1] - gas[0]) / 4.0, rel=0.05)
    drawn_back = made.recipe.fps * (move.start + move.seconds * (np.arange(4) + PUSHING) / 4.0)
    assert gas[np.ceil(drawn_back).astype(int)] == pytest.approx(after[1:], rel=0.01)
    assert np.diff(gas).min() > -0.01 * np.diff(after).mean()


def test_a_hand_pump_that_is_worked_as_fast_as_one_can_brings_all_its_air():
    made = plan(Recipe.parse(STROKES.replace("strokes: 4", "strokes: 4\n    seconds: 1.4")))
    for frame in simulate(made, device="cpu"):
        assert frame.volume.min() > 0.0
    assert frame.volume.sum() == pytest.approx(made.budgets["one"].volume, rel=0.05)


def test_a_pump_that_brings_too_little_says_what_to_write_and_that_works(monkeypatch):
    head = (
        HEAD + "balloons: {one: {size: 350, length: 9, inflated: 16}}\nfps: 16\nphysics: {hold: 0}\nsteps:\n"
    )
    monkeypatch.setattr(choreography, "FEWEST_FRAMES", 3)
    with pytest.raises(SimulationFailed, match="the pump brought only") as error:
        list(simulate(plan(Recipe.parse(f"{head}  - inflate: one\n    seconds: 0.2\n")), device="cpu"))
    told = r"9\d% of the gas of one in 0\.2 s: expected a step (inflate: one) with (seconds: [\d.]+)$"
    found = re.search(told, str(error.value))
    assert found is not None, error.value
    assert list(simulate(plan(Recipe.parse(f"{head}  - {found[1]}\n    {found[2]}\n")), device="cpu"))
