"""What probably made a run unstable, and which setting helps."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.recipe.physics import MOST_SUBSTEPS

if TYPE_CHECKING:
    from balloon_usd.recipe import Recipe

LONGER_STEP = "a longer step (seconds)"


def steadier(recipe: Recipe, substeps: int) -> str:
    """Return the likely cause and the setting that helps, for a recipe that was run with so many substeps."""
    if recipe.physics.model == "kosaka":
        return _kosaka(recipe, substeps)
    more = min(2 * substeps, MOST_SUBSTEPS)
    if recipe.physics.mass_scaling == "none":
        finer = f"{{substeps: {more}}} or " if more > substeps else ""
        cause = f"{substeps} time steps a frame are too few for rubber of its true mass"
        return f"{cause}: physics: {finer}{{mass_scaling: selective}} makes the run steadier"
    if more == substeps:
        return f"the hands are too quick for it: {LONGER_STEP} makes the run steadier"
    return (
        f"time steps are too long for what the hands do: physics: {{substeps: {more}}} ({substeps} now) "
        f"or {LONGER_STEP} makes the run steadier"
    )


def _kosaka(recipe: Recipe, substeps: int) -> str:
    """More substeps make the model's springs stiffer, and so are no cure: its own constants are."""
    physics = recipe.physics
    own = sorted(physics.kosaka.model_fields_set)
    if own:
        them = f"leave out {', '.join(own)} under physics: kosaka"
        return (
            f"the recipe's own constants are the likely cause: {them}, and the model chooses what is steady"
        )
    if physics.substeps is not None:
        return f"{substeps} time steps a frame are the likely cause: leave out physics: substeps"
    if physics.gravity:
        return "its weight is the likely cause: physics: {gravity: 0} makes the run steadier"
    return f"the hands are too quick for its air: {LONGER_STEP} makes the run steadier"
