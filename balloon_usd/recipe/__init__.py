"""Recipes: the language balloon artists write, its strict reader, and its Python form.

Knows nothing of physics: a `Recipe` is text with its meaning checked.
"""

from __future__ import annotations

from balloon_usd.language.colors import LATEX_COLORS, Color
from balloon_usd.language.joint import Joint
from balloon_usd.language.problem import Notice, Problem, RecipeError
from balloon_usd.operations.lock import LockJoints
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.press import PressedBubble

from .balloons import Balloon
from .builder import RecipeBuilder
from .kosaka import Kosaka
from .physics import Physics
from .recipe import Recipe
from .schema import recipe_schema

__all__ = [
    "LATEX_COLORS",
    "Balloon",
    "Color",
    "Joint",
    "Kosaka",
    "LockJoints",
    "Notice",
    "Operation",
    "Physics",
    "PressedBubble",
    "Problem",
    "Recipe",
    "RecipeBuilder",
    "RecipeError",
    "recipe_schema",
]
