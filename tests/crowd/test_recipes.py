"""No wall goes through a wall in any frame of any figure, shipped or typed in by hand."""

from __future__ import annotations

from pathlib import Path

import pytest

from balloon_usd.recipe import Recipe
from tests.crowd.watched import crossings, watched

ROOT = Path(__file__).parents[2]
RECIPES = [
    *sorted((ROOT / "recipes").glob("*.yaml")),
    *sorted((ROOT / "recipes" / "book").glob("*.yaml")),
    *sorted((ROOT / "tests" / "crowd" / "recipes").glob("*.yaml")),
]


@pytest.mark.long
@pytest.mark.parametrize("path", RECIPES, ids=lambda path: path.stem)
def test_no_frame_of_a_figure_has_a_wall_in_a_wall(path):
    quality = watched(Recipe.load(path))
    assert not crossings(quality)
    found = quality.data()
    assert found is not None
    assert found["joints"]["lost"] == []
    assert found["creep"]["verdict"] != "off"
