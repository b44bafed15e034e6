"""Setting a finished figure straight: what of it has a twin, and what lies between twins."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.operations.aim import Aim
from balloon_usd.operations.curving import Curves
from balloon_usd.operations.moves import OTHER_SIDE, Straighten
from balloon_usd.plan.twins import twins_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.operations.score import Score
    from balloon_usd.plan.strip import Strip
    from balloon_usd.recipe import Recipe

STRAIGHTEN_SECONDS = 4.0
"""Setting a finished figure straight, s."""
STRAIGHTENED_SECONDS = 1.0
"""How long it comes to rest then, s."""


def straighten(recipe: Recipe, strips: Mapping[str, Strip], score: Score) -> None:
    """Let hands set the figure straight that they have let go of, if it has twins."""
    twins = tuple((left.name, right.name) for left, right in twins_of(recipe, strips))
    # Frozen joints do not bend.
    if not (recipe.symmetric and twins and recipe.physics.traits.winds):
        return
    left_out = {name for each in twins for name in each} | _told_aside(recipe) | recipe.piece.popped
    tubes = [strip for strip in strips.values() if strip.shape is None]
    between = tuple(b.name for strip in tubes for b in strip.bubbles if b.name not in left_out)
    last = len(recipe.steps)
    move = Straighten(score.now, STRAIGHTEN_SECONDS, last, "set it straight", twins, between)
    score.retouch(move, STRAIGHTENED_SECONDS)


def _told_aside(recipe: Recipe) -> set[str]:
    """Return the bubbles that a recipe bends, curls, aims or points to one side."""
    found: set[str] = set()
    for step in recipe.steps:
        if isinstance(step, (Aim, Curves)) or getattr(step, "point", None) in OTHER_SIDE:
            found.update(step.names)
    return found
