"""How many joints are twisted into one."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from balloon_usd.language.joint import Joint
from balloon_usd.operations.workpiece import Joined

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.language.problem import Problem
    from balloon_usd.operations.workpiece import Workpiece
    from balloon_usd.recipe import Recipe

MOST_WELDED = 32
"""Joints that can be twisted into one: more necks than that leave no room for each other."""


def weld_problems(recipe: Recipe) -> Iterator[Problem]:
    """Yield the first step that twists too many joints into one, with all that hung together before."""
    if _most(recipe.piece) <= MOST_WELDED:
        return
    for step in (event.step for event in recipe.piece.history if isinstance(event, Joined)):
        if (most := _most(recipe.piece.after(step))) > MOST_WELDED:
            text = f"{most} joints would be twisted into one, expected at most {MOST_WELDED}"
            yield recipe.problem(("steps", step), text)
            return


def _most(piece: Workpiece) -> int:
    """Return how many joints along balloons are one, at most; neighbouring bubbles share one."""
    before = {
        Joint(behind, "start"): Joint(bubble, "end")
        for trail in piece.trails
        for bubble, behind in pairwise(trail)
    }
    return max(len({before.get(end, end) for end in ends}) for ends in piece.joints)
