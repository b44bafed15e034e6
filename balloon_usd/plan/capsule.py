"""Capsules: closed balloons without tail, as in the experiment (Kosaka 2008, chapter 4)."""

from __future__ import annotations

import math
from itertools import accumulate
from typing import TYPE_CHECKING

from balloon_usd.language.lengths import at_least, at_most, cm
from balloon_usd.language.problem import RecipeError, quoted
from balloon_usd.plan.necks import bubble_length, wall_length
from balloon_usd.plan.strip import Made, PlannedBubble

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.language.problem import Path, Problem
    from balloon_usd.plan.strip import Strip
    from balloon_usd.recipe import Recipe

SHORTEST = 0.58
"""Length of the shortest bubble and of the shortest rest, in radii: 1.5 cm of a 260, a few rows of faces."""
ROUND_OFF = 1e-8
"""Length that may lack without being missed, m."""


def capsule_bubbles(
    recipe: Recipe, strip: Strip, length: float, made: Sequence[Made], rest: tuple[str, int]
) -> tuple[PlannedBubble, ...]:
    """Return the bubbles of a capsule of this length (m), the rest as the last of them.

    `strip`: the capsule without bubbles. `rest`: name of what is left, and the step that names it.

    Raises:
        RecipeError: a bubble is too short, or the bubbles leave no rest.
    """
    radius = strip.inflated_radius
    least, necks = SHORTEST * radius, min(len(made), 1)
    walls = [wall_length(max(b.length, least), radius, _necks(k)) for k, b in enumerate(made)]
    needed = [*walls, wall_length(least, radius, necks)]
    problems = [*_too_short(recipe, strip, made, least), *_misfits(recipe, strip, length, made, needed)]
    if problems:
        raise RecipeError(problems)
    rest_length = bubble_length(length - sum(walls), radius, necks)
    entries = [*made, Made(rest[1], "rest", rest[0], rest_length)]
    along = [0.0, *accumulate(entry.length for entry in entries)]
    wall_along = [0.0, *accumulate(walls), length]
    return tuple(
        _bubble(strip, length, entry, (along[k], along[k + 1]), (wall_along[k], wall_along[k + 1]))
        for k, entry in enumerate(entries)
    )


def _necks(k: int) -> int:
    """Ends of a made bubble that are drawn together: the first one begins at the capsule's own round end."""
    return 1 if k == 0 else 2


def _too_short(recipe: Recipe, strip: Strip, made: Sequence[Made], least: float) -> Iterator[Problem]:
    for entry in made:
        if entry.length < least:
            text = f"{cm(entry.length)} is too short for a bubble of a {strip.size.name} capsule"
            yield recipe.problem(_place(recipe, entry), f"{text}, expected at least {at_least(least)}")


def _misfits(
    recipe: Recipe, strip: Strip, length: float, made: Sequence[Made], walls: Sequence[float]
) -> Iterator[Problem]:
    """The first bubble after which a capsule of a length (m) has no wall left for a rest.

    `walls`: wall (m) that every bubble takes, and last that of the shortest rest.
    """
    ends = list(accumulate(walls))
    for k, entry in enumerate(made):
        if ends[k] + walls[-1] > length + ROUND_OFF:
            left, after = length - ends[k] + walls[k], ends[-1] - ends[k]
            most = bubble_length(left - after, strip.inflated_radius, _necks(k))
            necks = "neck" if k == 0 else "necks"
            text = (
                f"{quoted(entry.bubble)} of {cm(entry.length)} does not fit: with its {necks} it takes "
                f"{cm(walls[k])}, {cm(left)} of {strip.balloon} is left and what follows needs "
                f"{at_least(after)}, expected {_remedy(strip, most, length, ends[-1])}"
            )
            yield recipe.problem(_place(recipe, entry), text)
            return


def _remedy(strip: Strip, most: float, length: float, needed: float) -> str:
    """What to do about a bubble that has room for `most`, in a capsule of a length where one is needed, m."""
    # What is written is rounded down to a millimetre.
    if most >= SHORTEST * strip.inflated_radius + 1e-3:
        remedy = f"at most {at_most(most)}"
    else:
        remedy = f"bubbles shorter by {at_least(needed - length)} in all"
    if needed <= strip.full_length:
        remedy += f", or a capsule of at least {at_least(needed)}"
    return remedy


def _place(recipe: Recipe, entry: Made) -> Path:
    return ("steps", entry.step, *recipe.steps[entry.step].path_of(entry.bubble))


def _bubble(
    strip: Strip, length: float, entry: Made, place: tuple[float, float], wall: tuple[float, float]
) -> PlannedBubble:
    until = [_volume_until(along, length, strip.inflated_radius) for along in wall]
    return PlannedBubble(
        name=entry.bubble,
        balloon=strip.balloon,
        kind=entry.kind,
        length=entry.length,
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
