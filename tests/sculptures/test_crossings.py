"""Walls do not pass through each other, also where bubbles are hard or folded sharply."""

from __future__ import annotations

from collections import deque
from pathlib import Path

import pytest

from balloon_usd.plan import plan
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.pierced_walls import Crossings
from balloon_usd.quality.walls import walls_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

HARD = """format: 1
name: hard
units: cm
balloons:
  main: {size: 260, length: 22, tail: 6}
steps:
  - bubbles: {nose: 3, left_ear: 3, right_ear: 3}
  - lock: [left_ear, right_ear]
    point: up
  - bubbles: {left_foreleg: 5, right_foreleg: 5}
  - lock: [left_foreleg, right_foreleg]
    point: down
  - rest: tail
"""
FOLDED = """format: 1
name: folded
units: in
balloons:
  main: {size: 260, tail: 1.5}
steps:
  - bubbles: {handle: 4, first_loop: 8, second_loop: 8, third_loop: 8}
  - lock: {joints: [handle.end, first_loop.end, second_loop.end, third_loop.end]}
  - rest: blade
"""
TUBE = """format: 1
name: tube
units: cm
balloons:
  main: {{size: 260, {blown}}}
steps:
  - bubbles: {{front: 10}}
  - rest: tail
"""
FIRST_BULGE_FRAMES = 36
"""Frames at 24 a second in which the first bulge of that tube grows."""


def crossings_at_the_end(text: str, folder: Path) -> Crossings:
    recipe = folder / "recipe.yaml"
    recipe.write_text(text)
    planned = plan(Recipe.load(recipe))
    simulation = simulate_many([planned], device="cpu")
    (last,) = deque(simulation.frames(), maxlen=1).pop()
    return CrossingCounter(walls_of(planned, simulation.meshes[0]), frames=1).count(last.points)


def test_bubbles_that_are_pressed_together_harder_than_20_kpa_do_not_cross(tmp_path):
    found = crossings_at_the_end(HARD, tmp_path)
    assert found.count == 0, found.pairs


def test_the_crease_of_a_sharp_fold_does_not_cross_itself(tmp_path):
    found = crossings_at_the_end(FOLDED, tmp_path)
    assert found.count == 0, found.pairs


@pytest.mark.parametrize("blown", ["length: 24, tail: 6", "inflated: 22"])
def test_the_first_bulge_of_a_balloon_crosses_neither_the_knot_nor_the_flat_tail(blown):
    planned = plan(Recipe.parse(TUBE.format(blown=blown)))
    simulation = simulate_many([planned], device="cpu")
    counter = CrossingCounter(walls_of(planned, simulation.meshes[0]), FIRST_BULGE_FRAMES)
    for frame, _ in zip(simulation.frames(), range(FIRST_BULGE_FRAMES), strict=False):
        found = counter.count(frame[0].points)
        assert found.count == 0, found.pairs
