"""The flat tubes of a recipe, with its own dimensions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.balloon.sizes import size_named

if TYPE_CHECKING:
    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.recipe import Recipe


def tube_sizes(recipe: Recipe) -> dict[str, BalloonSize]:
    """Return the size of every balloon that is a tube, by name."""
    return {
        name: size_named(balloon.size).with_overrides(balloon.radius, balloon.length, balloon.thickness)
        for name, balloon in recipe.balloons.items()
        if balloon.size is not None
    }
