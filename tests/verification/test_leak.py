"""V19: gas that permeates through the wall for hours, and which bubbles fail first."""

from __future__ import annotations

import math

import numpy as np

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

FULL = """
format: 1
name: full
units: cm
balloons:
  main: {size: 260, tail: 0.5}
steps: [wait: 0.5]
physics: {hold: 0.5, leak: LEAK}
"""
LOCKED = """
format: 1
name: locked
units: cm
balloons:
  main: {size: 260, length: 16, tail: 5}
steps:
  - bubbles: {small: 3, left: 9, right: 9}
  - lock: [small, left, right]
physics: {hold: 3, leak: 2 days}
"""
BARRER = 3.348e-16
"""mol m / (m2 s Pa)."""
DAY = 86400.0


def left_of(text):
    """Perform a recipe; return the gas of its bubbles when it is let go and at the end, mol, and its frames."""
    made = plan(Recipe.parse(text))
    simulation = simulate_many([made], detail="draft", device="cpu")
    amounts, frames = [], []
    for (frame,) in simulation.frames():
        amounts.append(simulation.model.scene.amount.numpy()[2:].copy())
        frames.append(frame)
    begin = next(k for k, frame in enumerate(frames) if frame.doing == "hold") - 1
    return amounts[begin], amounts[-1], frames[begin:]


def test_a_full_260_loses_about_half_of_its_gas_in_a_day(verify):
    before, after, frames = left_of(FULL.replace("LEAK", "1 h"))
    lost = (before - after).sum()
    verify(
        "V19",
        "260 full of air, loss in the first day at that rate, %",
        2400.0 * lost / before.sum(),
        53.0,
        4.0,
    )
    # The wall of physics's full 260: 51 mm wide, 1.52 m long, 7.7 um thick, through which 11 barrer leak.
    area = frames[0].volume.sum() / 0.0255 * 2.0
    theory = (0.79 * 8.0 + 0.21 * 23.0) * BARRER * area / 7.7e-6 * frames[0].pressure[0] * 3600.0
    verify("V19", "260 full of air, loss in an hour, mmol", 1e3 * lost, 1e3 * theory, 0.1)


def test_it_slows_down_as_the_balloon_gets_softer(note):
    before, after, _ = left_of(FULL.replace("LEAK", "12 h"))
    share = 1.0 - after.sum() / before.sum()
    note("V19", f"260 full of air after 12 h: {100.0 * share:.0f} % lost")
    assert 0.05 < share < 0.265


def test_small_bubbles_fail_first(note):
    before, after, frames = left_of(LOCKED)
    left = after / before
    told = ", ".join(f"{100.0 * share:.0f} %" for share in left)
    note("V19", f"bubbles of 3, 9 and 9 cm and the rest after 2 days: {told} of their gas left")
    assert left[0] < left[1:].min() - 0.05
    assert left[1] > 0.2
    assert frames[-1].volume[0] / frames[0].volume[0] < frames[-1].volume[1] / frames[0].volume[1]
    assert (np.array([frame.pressure for frame in frames]) > 0.0).all()


def test_two_days_take_as_much_however_long_they_are_shown():
    short = left_of(LOCKED.replace("hold: 3", "hold: 2.5"))
    long = left_of(LOCKED.replace("hold: 3", "hold: 5"))
    for one, other in zip(short[1] / short[0], long[1] / long[0], strict=True):
        assert math.isclose(one, other, rel_tol=0.1)


def test_nothing_leaks_unless_it_is_asked_for():
    before, after, _ = left_of(LOCKED.replace(", leak: 2 days", ""))
    assert np.abs(after - before).max() < 1e-12 * before.max()
