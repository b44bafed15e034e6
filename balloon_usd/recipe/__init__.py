"""Recipes: the language balloon artists write, its strict reader, and its Python form.

Knows nothing of physics: a `Recipe` is text with its meaning checked.
"""

from __future__ import annotations

from balloon_usd.language.colors import LATEX_COLORS, Color
from balloon_usd.language.problem import Problem, RecipeError

from .balloons import Balloon
from .builder import RecipeBuilder
from .kosaka import Kosaka
from .physics import Physics
from .recipe import Recipe
from .schema import recipe_schema
from .steps import Joint, LockJoints, PushedBubble, Step

__all__ = [
    "LATEX_COLORS",
    "Balloon",
    "Color",
    "Joint",
    "Kosaka",
    "LockJoints",
    "Physics",
    "Problem",
    "PushedBubble",
    "Recipe",
    "RecipeBuilder",
    "RecipeError",
    "Step",
    "recipe_schema",
]
