"""Variations of a recipe: parameter sweeps and random crowds, written as recipes.

A parameter is a place in the recipe and its values. Every combination becomes the text of a recipe, which is
read and planned as a run would, and is written if it can be made.
"""

from __future__ import annotations

from .error import VariationError, VariationNotWrittenError
from .result import LeftOut, Variation, Variations
from .vary import vary_recipe

__all__ = [
    "LeftOut",
    "Variation",
    "VariationError",
    "VariationNotWrittenError",
    "Variations",
    "vary_recipe",
]
