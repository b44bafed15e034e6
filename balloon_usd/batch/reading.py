"""Plans of recipes that were surveyed before."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe

if TYPE_CHECKING:
    from balloon_usd.batch.messages import Part
    from balloon_usd.plan import Plan


class RecipeChanged(Exception):  # noqa: N818
    """A recipe is no longer what it was when it was surveyed."""


def planned(part: Part) -> Plan:
    """Return the plan of a sculpture.

    Raises:
        RecipeChanged: its file says something else than before.
        RecipeError: it is no recipe any more.
    """
    recipe = Recipe.load(Path(part.file))
    if recipe.sha256 != part.sha256:
        raise RecipeChanged(f"{part.file}: the file was changed during the run")
    return plan(recipe)
