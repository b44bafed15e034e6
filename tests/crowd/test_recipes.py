"""No wall goes through a wall in any frame of any figure, shipped or typed in by hand."""

from __future__ import annotations

from pathlib import Path

import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.simulation import simulate_many
from tests.crowd.watched import crossings, watched

ROOT = Path(__file__).parents[2]
JAMMED = ROOT / "recipes" / "book" / "icosahedron_centre.yaml"
"""A net that closes over its spokes: no hand leads them past each other."""
RECIPES = [
    *sorted((ROOT / "recipes").glob("*.yaml")),
    *sorted((ROOT / "recipes" / "book").glob("*.yaml")),
    *sorted((ROOT / "tests" / "crowd" / "recipes").glob("*.yaml")),
]
RECIPES.remove(JAMMED)


@pytest.mark.long
@pytest.mark.parametrize("path", RECIPES, ids=lambda path: path.stem)
def test_no_frame_of_a_figure_has_a_wall_in_a_wall(path):
    quality = watched(Recipe.load(path))
    assert not crossings(quality)
    found = quality.data()
    assert found is not None
    assert found["joints"]["lost"] == []
    assert found["creep"]["verdict"] != "off"


@pytest.mark.long
def test_a_figure_that_jams_ends_and_says_which_bubbles_are_in_each_others_way():
    simulation = simulate_many([plan(Recipe.load(JAMMED))], detail="draft", device="cpu")
    *_, (last,) = simulation.frames()
    assert isinstance(last, SimulationFailed)
    assert "jammed" in last.cause
    assert "edge_" in last.cause
