"""From a recipe to its plan."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.language.problem import RecipeError
from balloon_usd.plan.choreography import choreograph, pace_problems
from balloon_usd.plan.fit import fit_problems
from balloon_usd.plan.laid_out import LaidOut
from balloon_usd.plan.laying import lay_strips
from balloon_usd.plan.model import Plan
from balloon_usd.plan.rings import RingTable
from balloon_usd.plan.settings import settings_problems
from balloon_usd.plan.tube_sizes import tube_sizes
from balloon_usd.plan.welding import weld_problems

if TYPE_CHECKING:
    from balloon_usd.recipe import Recipe


def plan(recipe: Recipe) -> Plan:
    """Return the plan of a recipe: strips, rings and choreography, from which all else follows.

    Raises:
        RecipeError: the recipe asks for what a balloon cannot give or no run can do, with the places in its
            file.
    """
    tubes = tube_sizes(recipe)
    problems = settings_problems(recipe, tubes)
    try:
        strips = lay_strips(recipe, tubes)
        table = RingTable(strips)
        problems += fit_problems(recipe, strips, LaidOut(strips, table))
        choreography = choreograph(recipe, strips, table)
    except RecipeError as error:
        raise RecipeError([*problems, *error.problems]) from None
    problems += pace_problems(recipe, choreography)
    problems += weld_problems(recipe)
    if problems:
        raise RecipeError(problems)
    return Plan(recipe, strips, table, choreography)
