"""What the search for walls leaves out at once are walls that a vertex never touches."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

RECIPE = """
format: 1
name: ears
units: cm
balloons:
  main: {{size: 260, length: 14, tail: 6}}
steps:
  - bubbles: {{nose: 3, left_ear: 4, right_ear: 4}}
  - lock: [left_ear, right_ear]
    point: up
  - rest: tail
physics: {{model: {model}}}
"""


@pytest.mark.parametrize("model", ["latex", "kosaka"])
def test_quads_left_out_are_of_the_same_bubble_and_near_along_it(model):
    plans = [plan(Recipe.parse(RECIPE.format(model=model)))] * 2
    scene = simulate_many(plans, device="cpu")._batches[0].model.scene
    s = {name: array.numpy() for name, array in scene.arrays.items() if hasattr(array, "numpy")}
    begin, end = s["vertex_own"].T
    assert np.mean(end > begin) > 0.9
    for i in range(len(begin)):
        own = np.arange(begin[i], end[i])
        assert (s["quad_balloon"][own] == s["vertex_balloon"][i]).all()
        apart = np.abs(s["quad_place"][own] - s["vertex_place"][i]).max(initial=0.0)
        assert apart <= scene.touch.apart * s["balloon_radius"][s["vertex_balloon"][i]]
        if s["vertex_segment"][i] >= 0:
            assert (s["quad_segment"][own] == s["vertex_segment"][i]).all()
