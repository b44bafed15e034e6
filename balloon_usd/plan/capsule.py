"""Capsules: closed balloons without tail, as in the experiment (Kosaka 2008, chapter 4)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.plan.lengths import at_least, at_most, cm
from balloon_usd.plan.strip import Made, PlannedBubble
from balloon_usd.recipe.problem import RecipeError, quoted

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.plan.strip import Strip
    from balloon_usd.recipe import Recipe
    from balloon_usd.recipe.problem import Path, Problem

SHORTEST = 0.58
"""Length of the shortest bubble and of the shortest rest, in radii: 1.5 cm of a 260, a few rows of faces."""


NECK_EXCESS = 0.5 * math.pi - 1.0
"""Wall that a neck takes beyond the bubble's length, in radii of its round end: a quarter circle instead of a
straight wall.
"""


def wall_length(length: float, radius: float, necks: int) -> float:
    """Return the length (m) of wall that a bubble of a length (m) takes from a tube of a radius (m).

    `necks`: how many of its ends are drawn together.
    """
    return length + necks * NECK_EXCESS * min(radius, 0.5 * length)


def capsule_bubbles(
    recipe: Recipe, strip: Strip, length: float, made: Sequence[Made], rest: tuple[str, int]
) -> tuple[PlannedBubble, ...]:
    """Return the bubbles of a capsule of this length (m), the rest as the last of them.

    `strip`: the capsule without bubbles. `rest`: name of what is left, and the step that names it.

    Raises:
        RecipeError: a bubble is too short, or the bubbles leave no rest.
    """
    radius = strip.inflated_radius
    least = SHORTEST * radius
    walls = [wall_length(entry.length, radius, 1 if k == 0 else 2) for k, entry in enumerate(made)]
    rest_wall = wall_length(least, radius, min(len(made), 1))
    needed = sum(walls) + rest_wall
    problems: list[Problem] = []
    bubbles: list[PlannedBubble] = []
    along, wall_along = 0.0, 0.0
    for entry, wall in zip(made, walls, strict=True):
        path: Path = ("steps", entry.step, recipe.steps[entry.step].kind, entry.bubble)
        if entry.length < least:
            text = f"{cm(entry.length)} is too short for a bubble of a {strip.size.name} capsule"
            problems.append(recipe.problem(path, f"{text}, expected at least {at_least(least)}"))
        if wall_along + wall + rest_wall > length:
            text = _misfit(entry, strip.balloon, length - wall_along, rest_wall)
            problems.append(recipe.problem(path, f"{text}, or a capsule of at least {at_least(needed)}"))
            break
        end, wall_end = along + entry.length, wall_along + wall
        bubbles.append(_bubble(strip, length, entry, (along, end), (wall_along, wall_end)))
        along, wall_along = end, wall_end
    if problems:
        raise RecipeError(problems)
    left = length - wall_along - (NECK_EXCESS * radius if made else 0.0)
    rest_length = max(left, least)
    entry = Made(rest[1], "rest", rest[0], rest_length)
    return (*bubbles, _bubble(strip, length, entry, (along, along + rest_length), (wall_along, length)))


def _misfit(entry: Made, balloon: str, left: float, least: float) -> str:
    text = f"{quoted(entry.bubble)} of {cm(entry.length)} does not fit: {cm(left)} of {balloon} is left"
    text += f", of which its rest needs {at_least(least)}"
    room = left - least
    return (
        f"{text}, expected at most {at_most(room)}" if room >= least else f"{text}, expected shorter bubbles"
    )


def _bubble(
    strip: Strip, length: float, entry: Made, place: tuple[float, float], wall: tuple[float, float]
) -> PlannedBubble:
    until = [_volume_until(along, length, strip.inflated_radius) for along in wall]
    return PlannedBubble(
        name=entry.bubble,
        balloon=strip.balloon,
        kind=entry.kind,
        length=place[1] - place[0],
        start=place[0],
        end=place[1],
        rest_start=wall[0],
        rest_end=wall[1],
        volume=until[1] - until[0],
        step=entry.step,
    )


def _volume_until(along: float, length: float, radius: float) -> float:
    """Volume (m3) of a capsule from its start pole to a place along its axis (m)."""
    if along > 0.5 * length:
        whole = math.pi * radius**2 * (length - 2.0 / 3.0 * radius)
        return whole - _volume_until(length - along, length, radius)
    in_cap = min(along, radius)
    return math.pi * (radius * in_cap**2 - in_cap**3 / 3.0 + radius**2 * (along - in_cap))
