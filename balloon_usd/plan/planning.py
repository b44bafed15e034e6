"""From a recipe to its plan."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.plan.budget import budget_of
from balloon_usd.plan.choreography import choreograph
from balloon_usd.plan.graph import sculpture_graph
from balloon_usd.plan.judgement import cautions_of
from balloon_usd.plan.laying import lay_strips
from balloon_usd.plan.model import Plan
from balloon_usd.plan.rings import RingTable

if TYPE_CHECKING:
    from balloon_usd.recipe import Recipe


def plan(recipe: Recipe) -> Plan:
    """Return the plan of a recipe: strips, graph, budgets, cautions and choreography.

    Raises:
        RecipeError: the recipe asks for what a balloon cannot give, with the places in its file.
    """
    strips = lay_strips(recipe)
    graph = sculpture_graph(recipe, strips)
    budgets = {name: budget_of(strip) for name, strip in strips.items() if not strip.capsule}
    table = RingTable(strips)
    cautions = cautions_of(recipe, strips, graph, budgets)
    return Plan(recipe, strips, graph, budgets, cautions, table, choreograph(recipe, strips, table))
