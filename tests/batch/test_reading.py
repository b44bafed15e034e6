from __future__ import annotations

import pytest

from balloon_usd.batch.reading import LARGEST, RecipeChanged, packed, planned
from balloon_usd.origin import origin_of
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from tests.batch.runs import ROOT
from tests.command_line import RECIPE

DOG = ROOT / "recipes" / "dog.yaml"


def surveyed(file):
    found = plan(Recipe.load(file))
    return str(file), origin_of(found), packed(found)


def assert_same(one, other):
    assert (one.recipe, one.strips, one.choreography) == (other.recipe, other.strips, other.choreography)
    assert one.table.rings == other.table.rings


def test_a_plan_is_the_same_in_another_process():
    found = surveyed(DOG)
    assert 0 < len(found[-1]) < LARGEST
    assert_same(planned(*found), plan(Recipe.load(DOG)))


def test_a_recipe_that_is_not_packed_is_planned_again():
    assert_same(planned(*surveyed(DOG)[:2]), planned(*surveyed(DOG)))


def test_a_plan_of_meshes_is_not_packed():
    found = plan(Recipe.load(ROOT / "recipes" / "meshes" / "heart.yaml"))
    assert packed(found) == b""


def test_a_packed_recipe_that_was_changed_is_noticed(tmp_path):
    file = tmp_path / "a.yaml"
    file.write_text(RECIPE.format(name="a", fps=24))
    found = surveyed(file)
    file.write_text(file.read_text() + "# more\n")
    with pytest.raises(RecipeChanged, match="was changed during the run"):
        planned(*found)
