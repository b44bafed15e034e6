"""The recipes of the book: figures of published instructions, planned and not simulated here."""

from __future__ import annotations

from pathlib import Path

import networkx as nx
import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe

BOOK = Path(__file__).parents[2] / "recipes" / "book"
RECIPES = sorted(BOOK.glob("*.yaml"))
SOLIDS = {
    "tetrahedron_2": nx.tetrahedral_graph,
    "tetrahedron_centre": nx.tetrahedral_graph,
    "tetrahedron_pop": nx.tetrahedral_graph,
    "cube_4": nx.cubical_graph,
    "cube_centre": nx.cubical_graph,
    "octahedron": nx.octahedral_graph,
    "icosahedron_centre": nx.icosahedral_graph,
    "dodecahedron_3": nx.dodecahedral_graph,
    "dodecahedron_10": nx.dodecahedral_graph,
}
"""Polyhedra by the names of their recipes: their edges are called edge_..., whatever else they have."""


def test_the_book_has_recipes() -> None:
    assert {path.stem for path in RECIPES} > SOLIDS.keys()


@pytest.mark.parametrize("path", RECIPES, ids=lambda path: path.stem)
def test_a_recipe_of_the_book_is_planned_and_says_what_it_is_and_where_it_is_from(path: Path) -> None:
    recipe = Recipe.load(path)
    assert recipe.title
    assert recipe.source
    plan(recipe)


@pytest.mark.parametrize("path", RECIPES, ids=lambda path: path.stem)
def test_every_twist_of_the_book_holds_but_that_between_two_kissing_noses(path: Path) -> None:
    loose = [str(joint.end) for joint in plan(Recipe.load(path)).loose]
    assert loose == (["her_nose.end"] if path.stem == "kissing_poodles" else [])


@pytest.mark.parametrize("name", SOLIDS)
def test_a_polyhedron_of_the_book_has_the_edges_of_its_solid(name: str) -> None:
    graph = plan(Recipe.load(BOOK / f"{name}.yaml")).graph
    edges = nx.Graph((edge.start, edge.end) for edge in graph.edges if edge.bubble.startswith("edge_"))
    assert nx.is_isomorphic(edges, SOLIDS[name]())
