"""V32: a balloon does not know what it will be twisted into: until then it is as long and as hard as any other."""

from __future__ import annotations

from functools import cache
from itertools import islice

import numpy as np
import pytest

from balloon_usd.operations.moves import Pinch
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

WHOLE = """
format: 1
name: whole
units: cm
fps: 12
balloons:
  main: {size: 260, length: 40, tail: 6}
steps:
  - inflate: main
    seconds: 4
  - bubbles: {BUBBLES}
  - rest: beyond
physics: {hold: 0.1}
"""
TO_COME = {
    1: "a: 10",
    8: ", ".join(f"b{k}: 10" for k in range(8)),
    24: ", ".join(f"b{k}: 3" for k in range(24)),
}
"""Bubbles that are twisted later, by their number."""


@cache
def blown_up(bubbles: int) -> tuple[float, float, float]:
    """Length of the blown up tube (m), its pressure (Pa) and its rubber (m3) before the first pinch."""
    planned = plan(Recipe.parse(WHOLE.replace("BUBBLES", TO_COME[bubbles])))
    pinch = min(move.start for move in planned.choreography.moves if isinstance(move, Pinch))
    simulation = simulate_many([planned], detail="draft", device="cpu")
    *_, (frame,) = islice(simulation.frames(), round(pinch * planned.recipe.fps))
    points = frame.points[0]
    across = np.hypot(points[:, 1], points[:, 2])
    wide = points[across > 0.5 * across.max(), 0]
    scene = simulation.model.scene
    return (
        float(np.ptp(wide)),
        float(frame.pressure.max()),
        float(scene.rubber_volume.numpy().sum(dtype=np.float64)),
    )


def test_a_neck_that_comes_undone_gives_its_rubber_back(verify):
    planned = plan(Recipe.parse(WHOLE.replace("BUBBLES", "a: 5, b: 3").replace("hold: 0.1", "hold: 3")))
    simulation = simulate_many([planned], detail="draft", device="cpu")
    rubber, undone = [], ()
    for (frame,) in simulation.frames():
        rubber.append(simulation.model.scene.rubber_volume.numpy().sum(dtype=np.float64))
        undone = frame.undone
    assert len(undone) == 2
    assert min(rubber) < 0.997 * rubber[0]
    verify("V32", "twists come undone, rubber, mm3", 1e9 * rubber[-1], 1e9 * rubber[0], 1e-5)


@pytest.mark.parametrize("bubbles", [8, 24])
def test_a_balloon_is_the_same_whatever_it_will_be_twisted_into(verify, bubbles):
    length, pressure, rubber = blown_up(bubbles)
    theory = blown_up(1)
    what = f"{bubbles} bubbles to come"
    verify("V32", f"{what}, length, mm", 1e3 * length, 1e3 * theory[0], 1e-3)
    verify("V32", f"{what}, pressure, Pa", pressure, theory[1], 1e-3)
    verify("V32", f"{what}, rubber, mm3", 1e9 * rubber, 1e9 * theory[2], 2e-5)
