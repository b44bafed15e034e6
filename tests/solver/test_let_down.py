"""Balloons that are blown up farther and let down."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd import simulate
from balloon_usd.balloon.ringed_faces import polygon_share
from balloon_usd.plan import plan
from balloon_usd.plan.overblowing import load_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.run_summary import RunSummary

ONE = """
format: 1
name: one
units: cm
balloons:
  one: {{size: R5, inflated: 8{overblown}}}
steps:
  - {{{inflate}}}
  - {{rest: whole, balloon: one}}
physics: {{hold: 0.3}}
"""
STEADY = "inflate: one"
STROKES = "inflate: one, strokes: 4"


def made(overblown, inflate=STEADY):
    """A plan, the share of its gas that its mesh holds, and pressures and volumes of all frames."""
    planned = plan(Recipe.parse(ONE.format(overblown=overblown, inflate=inflate)))
    simulation = simulate(planned, device="cpu")
    share = polygon_share(simulation.meshes[0].around)
    frames = [(float(frame.pressure[0]), float(frame.volume[0])) for frame in simulation]
    return planned, share, np.array(frames)


@pytest.mark.parametrize("inflate", [STEADY, STROKES])
def test_it_holds_the_gas_of_both_widths_one_after_the_other(inflate):
    planned, share, frames = made(", overblown: 12", inflate)
    blown = planned.strips["one"].blown
    assert frames[:, 1].max() == pytest.approx(share * blown.before.volume, rel=0.02)
    assert frames[-1, 1] == pytest.approx(share * blown.volume, rel=0.01)
    assert len(frames) == planned.frame_count


def test_it_is_softer_than_one_that_was_not():
    (_, _, before), (_, _, after) = made(""), made(", overblown: 12")
    assert after[-1, 1] == pytest.approx(before[-1, 1], rel=0.02)
    assert after[-1, 0] < 0.6 * before[-1, 0]


def test_air_goes_out_evenly_and_none_comes_back():
    _, _, frames = made(", overblown: 12")
    falls = np.diff(frames[frames[:, 1].argmax() :, 1])
    assert falls.max() < 1e-3 * frames[-1, 1]
    assert falls.min() > -0.05 * frames[:, 1].max()


def test_its_load_is_told_as_it_was_before_air_was_let_out():
    planned = plan(Recipe.parse(ONE.format(overblown=", overblown: 16", inflate=STEADY)))
    simulation = simulate(planned, device="cpu")
    summary = RunSummary(planned, tuple(simulation.meshes))
    for frame in simulation:
        summary.add(frame)
    strip = planned.strips["one"]
    assert summary.wall_load.load == pytest.approx(load_of(strip.rubber, strip.size, 0.16), rel=0.05)
