"""Where results come from: the recipe, the mesh files, the solver."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from balloon_usd.plan import Plan
    from balloon_usd.recipe import Recipe


def provenance_of(recipe: Recipe) -> dict[str, str]:
    """Return where results of a recipe come from: its file, the hash of its text, the solver's version."""
    return {
        # Stages hold text, which the name of a file need not be.
        "recipe": Path(recipe.file).name.encode("utf-8", "surrogateescape").decode("utf-8", "replace"),
        "recipe_sha256": recipe.sha256,
        "solver": recipe.physics.traits.version,
    }


def origin_of(plan: Plan) -> dict[str, str]:
    """Return where results of a plan come from: its recipe and the mesh files that balloons come from."""
    hashes = [strip.shape.file_sha256 for strip in plan.strips.values() if strip.shape is not None]
    meshes = {"mesh_sha256": " ".join(hashes)} if hashes else {}
    return {**provenance_of(plan.recipe), **meshes}
