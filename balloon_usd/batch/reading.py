"""Plans of recipes that were surveyed before."""

from __future__ import annotations

import hashlib
import pickle
import zlib
from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.origin import origin_of
from balloon_usd.plan import Plan, plan
from balloon_usd.recipe import Recipe
from balloon_usd.recipe.recipe_file import read_recipe_file

if TYPE_CHECKING:
    from collections.abc import Mapping

LARGEST = 2**16
"""Packed plan that the scheduler keeps, at most: those of meshes hold their vertices [B]."""
FAST = 1
"""Level of compression: a plan of 15 kB becomes one of 5 kB in 0.2 ms."""


class RecipeChanged(Exception):  # noqa: N818
    """A recipe, or a mesh that it names, is no longer what it was when it was surveyed."""


def packed(plan: Plan) -> bytes:
    """Return a plan for other processes, ten times as fast as planning anew; empty if it is large."""
    if plan.of_meshes:
        return b""
    # What a simulation asks for late is found here, so that no frame waits for it.
    _ = plan.loose
    data = zlib.compress(pickle.dumps(plan, pickle.HIGHEST_PROTOCOL), FAST)
    return data if len(data) <= LARGEST else b""


def planned(file: str, origin: Mapping[str, str], known: bytes = b"") -> Plan:
    """Return the plan of a sculpture.

    Args:
        file: of its recipe.
        origin: as it was surveyed, see `origin.origin_of`.
        known: the plan, packed, if it is.

    Raises:
        RecipeChanged: its file, or that of a mesh, says something else than before.
        RecipeError: it is no recipe any more.
    """
    text = read_recipe_file(file)
    if known and hashlib.sha256(text.encode("utf-8")).hexdigest() == origin["recipe_sha256"]:
        found: Plan = pickle.loads(zlib.decompress(known))  # noqa: S301  # from ourselves
        return found
    found = plan(Recipe.load(Path(file)))
    if origin_of(found) != origin:
        raise RecipeChanged(f"{file}: the recipe was changed during the run")
    return found
