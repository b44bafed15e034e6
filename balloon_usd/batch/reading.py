"""Plans of recipes that were surveyed before."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.batch.facts import origin_of
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe

if TYPE_CHECKING:
    from balloon_usd.batch.messages import Part
    from balloon_usd.plan import Plan


class RecipeChanged(Exception):  # noqa: N818
    """A recipe, or a mesh that it names, is no longer what it was when it was surveyed."""


def planned(part: Part) -> Plan:
    """Return the plan of a sculpture.

    Raises:
        RecipeChanged: its file, or that of a mesh, says something else than before.
        RecipeError: it is no recipe any more.
    """
    found = plan(Recipe.load(Path(part.file)))
    if origin_of(found) != part.origin:
        raise RecipeChanged(f"{part.file}: the recipe was changed during the run")
    return found
