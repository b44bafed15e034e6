"""From a recipe to its plan."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.language.problem import RecipeError
from balloon_usd.plan.budget import budget_of
from balloon_usd.plan.choreography import choreograph
from balloon_usd.plan.graph import sculpture_graph
from balloon_usd.plan.holding import holding_of
from balloon_usd.plan.judgement import cautions_of
from balloon_usd.plan.laying import lay_strips
from balloon_usd.plan.model import Plan
from balloon_usd.plan.rings import RingTable
from balloon_usd.plan.settings import pace_problems, settings_problems
from balloon_usd.plan.welding import weld_problems

if TYPE_CHECKING:
    from balloon_usd.recipe import Recipe


def plan(recipe: Recipe) -> Plan:
    """Return the plan of a recipe: strips, graph, budgets, cautions and choreography.

    Raises:
        RecipeError: the recipe asks for what a balloon cannot give or no run can do, with the places in its
            file.
    """
    problems = settings_problems(recipe)
    try:
        strips = lay_strips(recipe)
    except RecipeError as error:
        raise RecipeError([*problems, *error.problems]) from None
    graph, holding = sculpture_graph(recipe, strips), holding_of(recipe, strips)
    budgets = {name: budget_of(strip) for name, strip in strips.items() if strip.has_tail}
    table = RingTable(strips)
    cautions = cautions_of(recipe, strips, graph, budgets)
    choreography = choreograph(recipe, strips, table)
    problems += pace_problems(recipe, choreography)
    problems += weld_problems(recipe, choreography)
    if problems:
        raise RecipeError(problems)
    return Plan(recipe, strips, graph, holding, budgets, cautions, table, choreography)
