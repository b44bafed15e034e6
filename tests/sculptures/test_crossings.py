"""Walls do not pass through each other, also where bubbles are hard or folded sharply."""

from __future__ import annotations

from collections import deque
from pathlib import Path

from balloon_usd.plan import plan
from balloon_usd.quality.pierced_walls import crossings_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

BOOK = Path(__file__).parents[2] / "recipes/book"
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


def crossings_at_the_end(recipe: Recipe) -> dict:
    planned = plan(recipe)
    simulation = simulate_many([planned], device="cpu")
    (last,) = deque(simulation.frames(), maxlen=1).pop()
    return crossings_of(planned, simulation.meshes[0], last)["crossings"]


def test_bubbles_that_are_pressed_together_harder_than_20_kpa_do_not_cross(tmp_path):
    recipe = tmp_path / "hard.yaml"
    recipe.write_text(HARD)
    found = crossings_at_the_end(Recipe.load(recipe))
    assert found["value"] == 0, found["bubbles"]


def test_the_crease_of_a_sharp_fold_does_not_cross_itself():
    found = crossings_at_the_end(Recipe.load(BOOK / "foil_cardinal.yaml"))
    assert found["value"] == 0, found["bubbles"]
