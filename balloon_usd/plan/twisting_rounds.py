"""Round balloons that are twisted in two, and more: how much wall and gas each bubble takes."""

from __future__ import annotations

import contextlib
import math
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.open_round import OpenRound
from balloon_usd.language.lengths import at_least, at_most, cm
from balloon_usd.language.problem import RecipeError, quoted
from balloon_usd.plan.blown import NECK_AT_KNOT

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.balloon.lobe_shape import Lobe
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.language.problem import Path, Problem
    from balloon_usd.plan.strip import BlownRound, Made, PlannedBubble
    from balloon_usd.recipe import Recipe

MOST_FLAT = 1.45
"""Width of the flattest lobe that is made, in its height. In simulations all lobes up to 1.49 are as planned,
and all from 1.53 on wind up to a bundle: one whose wall is slack round it is 1.67 times as wide as high.
"""
LEAST_RANGE = 2e-3
"""Range of heights of which none is told, m."""
LOBES = 9
"""Lobes among which the lowest and the highest that can be made are sought."""
HALVINGS = 5
"""How often the walls between those and their neighbours are halved, to tell them closely."""


def twisted_bubbles(
    recipe: Recipe,
    rest: PlannedBubble,
    size: BalloonSize,
    rubber: Rubber,
    blown: BlownRound,
    twisted: Sequence[Made],
) -> tuple[PlannedBubble, ...]:
    """Return the bubbles into which a round balloon is twisted, from its knot on; `rest`: all of it
    before.

    Raises:
        RecipeError: a bubble cannot be made, or not of such a balloon.
    """
    whole = size, rubber, blown
    try:
        _, left = twisted_round(*whole, ())
    except ValueError:
        text = f"what twists make of a {size.name} of these dimensions is not found, expected its own"
        raise RecipeError([recipe.problem(("balloons", rest.balloon), text)]) from None
    found: list[PlannedBubble] = []
    start = 0.0
    for number, made in enumerate(twisted):
        before, heights = left, tuple(each.length for each in twisted[: number + 1])
        try:
            lobe, left = twisted_round(*whole, heights)
        except ValueError:
            lobe = None
        if (problem := _problem(recipe, made, before, rest.balloon, lobe)) is not None:
            raise RecipeError([problem])
        assert lobe is not None, "of what is not found there is a problem"
        bubble = _placed(rest, lobe, made.length, start, (before.start, left.start))
        found.append(replace(bubble, name=made.bubble, kind=made.kind, step=made.step))
        start = bubble.end
    return (*found, _placed(rest, left.lobe, left.lobe.height, start, (left.start, size.length)))


def _placed(
    rest: PlannedBubble, lobe: Lobe, length: float, start: float, wall: tuple[float, float]
) -> PlannedBubble:
    """Return a bubble of a shape; `wall`: from where to where along the flat balloon it takes that, m."""
    return replace(
        rest,
        length=length,
        start=start,
        end=start + length,
        rest_start=wall[0],
        rest_end=wall[1],
        volume=lobe.volume,
        pressure=lobe.pressure,
        width=lobe.width,
    )


@lru_cache(maxsize=256)
def twisted_round(
    size: BalloonSize, rubber: Rubber, blown: BlownRound, heights: tuple[float, ...]
) -> tuple[Lobe, OpenRound]:
    """Return the last lobe of some heights (m) that are twisted off a round balloon, from its knot on, and
    what is left; of none the whole balloon.

    Raises:
        ValueError: the last one cannot be made.
    """
    if heights:
        return twisted_round(size, rubber, blown, heights[:-1])[1].twisted(heights[-1])
    neck = NECK_AT_KNOT * size.neck_radius
    whole = OpenRound.whole(size, rubber, neck, blown.volume, blown.most.volume)
    return whole.lobe, whole


def _problem(recipe: Recipe, made: Made, left: OpenRound, balloon: str, lobe: Lobe | None) -> Problem | None:
    """Return what is wrong with a bubble of a shape, if any is found; None where nothing is."""
    if made.gas < 1.0:
        text = "no gas is pressed out of bubbles of a round balloon, expected no such line"
        return recipe.problem(("steps", made.step, "burp"), text)
    if lobe is not None and lobe.width <= MOST_FLAT * lobe.height:
        return None
    path: Path = ("steps", made.step, *recipe.steps[made.step].path_of(made.bubble))
    return recipe.problem(path, _misfit(made, left, balloon, lobe))


def _misfit(made: Made, left: OpenRound, balloon: str, lobe: Lobe | None) -> str:
    """Say why a bubble is not twisted off what is left of a round balloon, and what would be."""
    what = f"what is left of {balloon}" if left.start > 0.0 else balloon
    text = f"{quoted(made.bubble)} of {cm(made.length)} is not twisted off {what}"
    if lobe is not None:
        text = f"{quoted(made.bubble)} of {cm(made.length)} would be {cm(lobe.width)} wide, all in folds"
    heights = fitting_heights(left)
    if heights is None:
        return f"{text}, expected fewer bubbles, or a balloon that is blown up less"
    less = ", or a balloon that is blown up less" if made.length < heights[0] else ""
    return f"{text}, expected {at_least(heights[0])} to {at_most(heights[1])}{less}"


def fitting_heights(left: OpenRound, hardest: float = math.inf) -> tuple[float, float] | None:
    """Return the heights (m) of the lowest and the highest bubble that is twisted off what is left of a round
    balloon, and is no harder than some gauge pressure (Pa); None where hardly any is.
    """
    least, most = left.lengths
    lengths = np.linspace(least, most, LOBES) if least < most else np.zeros(0)
    fits = [_fitting(left, length, hardest) is not None for length in lengths]
    if not any(fits):
        return None
    first, last = fits.index(True), len(fits) - 1 - fits[::-1].index(True)
    low = _edge(left, lengths[first], lengths[max(first - 1, 0)], hardest)
    high = _edge(left, lengths[last], lengths[min(last + 1, len(fits) - 1)], hardest)
    return (low, high) if low + LEAST_RANGE < high else None


def _edge(left: OpenRound, fits: float, fails: float, hardest: float) -> float:
    """Return the height (m) of the bubble at which those end that fit, between two lengths of wall, m."""
    for _ in range(HALVINGS):
        middle = 0.5 * (fits + fails)
        fits, fails = (fits, middle) if _fitting(left, middle, hardest) is None else (middle, fails)
    lobe = _fitting(left, fits, hardest)
    assert lobe is not None, "the first length fits"
    return lobe.height


def _fitting(left: OpenRound, length: float, hardest: float) -> Lobe | None:
    """Return the bubble of a length of wall (m) that is twisted off; None of one too flat or too hard."""
    with contextlib.suppress(ValueError):
        lobe, _ = left.parted(length)
        if lobe.width <= MOST_FLAT * lobe.height and lobe.pressure <= hardest:
            return lobe
    return None
