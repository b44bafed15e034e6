"""How many joints are twisted into one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.operations.moves import Weld

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.language.problem import Problem
    from balloon_usd.operations.moves import Choreography
    from balloon_usd.recipe import Recipe

MOST_WELDED = 32
"""Joints that can be twisted into one: more necks than that leave no room for each other."""


def weld_problems(recipe: Recipe, choreography: Choreography) -> Iterator[Problem]:
    """Yield the first step that twists too many joints into one, with all that hung together before."""
    together: dict[int, frozenset[int]] = {}
    for move in choreography.moves:
        if isinstance(move, Weld):
            merged = frozenset(move.rings).union(*(together.get(ring, ()) for ring in move.rings))
            together |= dict.fromkeys(merged, merged)
            if len(merged) > MOST_WELDED:
                text = f"{len(merged)} joints would be twisted into one, expected at most {MOST_WELDED}"
                yield recipe.problem(("steps", move.step), text)
                return
