"""Round balloons and hearts, blown up to a width, and what twists make of round ones."""

from __future__ import annotations

import contextlib
import math
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple, TypedDict

import numpy as np

from balloon_usd.balloon.ball_pressure import ball_pressure
from balloon_usd.balloon.open_round import OpenRound
from balloon_usd.language.lengths import at_least, at_most, cm
from balloon_usd.language.problem import RecipeError, quoted
from balloon_usd.plan.blown import NECK_AT_KNOT
from balloon_usd.plan.strip import BlownRound, PlannedBubble, Strip

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.balloon.lobe_shape import Lobe
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.language.problem import Path
    from balloon_usd.plan.strip import Made
    from balloon_usd.recipe import Recipe

BEYOND_FULL = 1.02
"""A width beyond the full one by this share means full: nominal widths are rounded."""
MOST_FLAT = 1.45
"""Width of the flattest lobe that is made, in its height. In simulations all lobes up to 1.49 are as planned,
and all from 1.53 on wind up to a bundle: one whose wall is slack round it is 1.67 times as wide as high.
"""
LEAST_RANGE = 2e-3
"""Range of heights of which none is told, m."""
LOBES = 9
"""Lobes of which the lowest and the highest that can be made are told, and how often what lies between those
and their neighbours is halved.
"""
HALVINGS = 5
FLAT_VOLUME = 1.9
"""Volume of a flat round one that is not pressed together, in that of a ball of its width."""


class Growth(NamedTuple):
    """How round balloons of a form grow; widths are in that of the flat one."""

    least: float
    """Least width to which one is blown up: below, its wall is hardly stretched."""
    full: float
    """Width of a full one."""
    shapes: tuple[tuple[float, float, float, float], ...]
    """Shapes by width: the volume, in that of a ball as wide, the height, in the width, and the pressure, in
    that of such a ball. Measured in simulations of both sizes in `preview`, which differ from these by 2 %.
    """


EGG = Growth(
    1.3,
    5.0,
    (
        (1.34, 1.40, 1.38, 0.72),
        (1.84, 1.14, 1.155, 0.93),
        (2.38, 1.017, 1.043, 1.00),
        (2.93, 0.994, 1.010, 1.005),
        (3.44, 1.020, 1.020, 0.975),
        (3.90, 1.074, 1.058, 0.925),
        (4.36, 1.122, 1.105, 0.873),
        (4.82, 1.164, 1.151, 0.83),
        (5.04, 1.185, 1.171, 0.815),
    ),
)
"""A pear at first, nearly a ball when half full, and a pear again when full; 5 inches are 13 cm."""
HEART = Growth(
    1.6,
    4.1,
    (
        (1.64, 0.811, 1.012, 1.342),
        (1.85, 0.790, 0.975, 1.430),
        (2.06, 0.788, 0.949, 1.548),
        (2.22, 0.788, 0.931, 1.652),
        (2.33, 0.766, 0.914, 1.730),
        (2.57, 0.728, 0.887, 1.888),
        (2.86, 0.698, 0.870, 2.062),
        (3.15, 0.690, 0.876, 2.212),
        (3.33, 0.700, 0.898, 2.288),
        (3.42, 0.711, 0.918, 2.317),
        (3.61, 0.668, 0.920, 2.363),
        (3.79, 0.638, 0.927, 2.387),
        (3.92, 0.623, 0.931, 2.403),
        (4.05, 0.610, 0.936, 2.425),
        (4.20, 0.600, 0.939, 2.440),
    ),
)
"""A ball with a dent at first; its lobes part from two thirds of its full width on. In its cleft a full one
is stretched to nine tenths of what bursts it.
"""


def round_strip(
    recipe: Recipe, name: str, size: BalloonSize, rubber: Rubber, twisted: Sequence[Made]
) -> Strip:
    """Return the strip of a round balloon or a heart, as wide as the recipe says, and what is twisted off it.

    Raises:
        RecipeError: it cannot be blown up to that width, or what is twisted off does not fit.
    """
    blown = _blown(recipe, name, size, rubber)
    bubble = recipe.piece.row(name)[-1]
    rest = PlannedBubble(
        name=bubble,
        balloon=name,
        kind="rest",
        length=blown.height,
        start=0.0,
        end=blown.height,
        rest_start=0.0,
        rest_end=size.length,
        volume=blown.volume,
        step=recipe.piece.bubbles[bubble].step,
        pressure=blown.pressure,
    )
    bubbles: tuple[PlannedBubble, ...] = (rest,)
    if twisted:
        wall = OpenWall(size, rubber, blown.volume)
        try:
            twisted_round(*wall, ())
        except ValueError:
            text = f"what twists make of a {size.name} of these dimensions is not found, expected its own"
            raise RecipeError([recipe.problem(("balloons", name), text)]) from None
        bubbles = _lobes(recipe, rest, wall, twisted)
    return Strip(name, size, rubber, 0.0, bubbles, blown=blown)


def _blown(recipe: Recipe, name: str, size: BalloonSize, rubber: Rubber) -> BlownRound:
    """What a round balloon or a heart is blown up to."""
    flat = 2.0 * size.radius
    least, full = widths_of(size)
    balloon = recipe.balloons[name]
    key, width = "inflated", full if balloon.inflated is None else balloon.inflated
    if balloon.filled is not None:
        key, width = "filled", 0.01 * balloon.filled * full
    if not least <= width <= BEYOND_FULL * full:
        what = "heart" if size.heart else "round balloon"
        text = f"a {what} {cm(flat)} wide while it is flat is not blown up to {cm(width)}"
        text += f", expected a width of {at_least(least)} to {at_most(full)}"
        raise RecipeError([recipe.problem(("balloons", name, key), text)])
    volume, height, pressure = _shape_of(_growth(size), width / flat)
    ball = ball_pressure(rubber, width / flat, size.thickness / size.radius)
    return BlownRound(width, height * width, volume * math.pi / 6.0 * width**3, pressure * ball)


class OpenWall(NamedTuple):
    """A round balloon that is blown up, as hands begin to twist it."""

    size: BalloonSize
    rubber: Rubber
    volume: float
    """Gas, m3."""


def _lobes(
    recipe: Recipe, rest: PlannedBubble, wall: OpenWall, twisted: Sequence[Made]
) -> tuple[PlannedBubble, ...]:
    """The bubbles into which a round balloon is twisted; `rest`: all of it before that."""
    found: list[PlannedBubble] = []
    heights: tuple[float, ...] = ()
    start, rest_start = 0.0, 0.0
    for made in twisted:
        if made.gas < 1.0:
            text = "no gas is pressed out of bubbles of a round balloon, expected no such line"
            raise RecipeError([recipe.problem(("steps", made.step, "burp"), text)])
        heights = (*heights, made.length)
        try:
            lobe, left = twisted_round(*wall, heights)
        except ValueError:
            lobe = None
        if lobe is None or lobe.width > MOST_FLAT * lobe.height:
            path: Path = ("steps", made.step, *recipe.steps[made.step].path_of(made.bubble))
            text = _misfit(made, twisted_round(*wall, heights[:-1])[1], rest.balloon, lobe)
            raise RecipeError([recipe.problem(path, text)])
        found.append(
            replace(
                rest,
                name=made.bubble,
                kind=made.kind,
                length=made.length,
                start=start,
                end=start + made.length,
                rest_start=rest_start,
                rest_end=left.start,
                step=made.step,
                **_gas_of(lobe),
            )
        )
        start, rest_start = start + made.length, left.start
    height = left.lobe.height
    end = replace(rest, length=height, start=start, end=start + height, rest_start=rest_start)
    return (*found, replace(end, **_gas_of(left.lobe)))


class _Gas(TypedDict):
    volume: float
    pressure: float
    width: float


def _gas_of(lobe: Lobe) -> _Gas:
    return {"volume": lobe.volume, "pressure": lobe.pressure, "width": lobe.width}


@lru_cache(maxsize=256)
def twisted_round(
    size: BalloonSize, rubber: Rubber, volume: float, heights: tuple[float, ...]
) -> tuple[Lobe, OpenRound]:
    """Return the last lobe of some heights (m) that are twisted off a round balloon with so much gas (m3),
    from its knot on, and what is left; of none the whole balloon.

    Raises:
        ValueError: the last one cannot be made.
    """
    if heights:
        return twisted_round(size, rubber, volume, heights[:-1])[1].twisted(heights[-1])
    whole = OpenRound.whole(size, rubber, NECK_AT_KNOT * size.neck_radius, volume)
    return whole.lobe, whole


def _misfit(made: Made, left: OpenRound, balloon: str, lobe: Lobe | None) -> str:
    """Say why a bubble is not twisted off what is left of a round balloon, and what would be."""
    what = f"what is left of {balloon}" if left.start > 0.0 else balloon
    text = f"{quoted(made.bubble)} of {cm(made.length)} is not twisted off {what}"
    if lobe is not None:
        text = f"{quoted(made.bubble)} of {cm(made.length)} would be {cm(lobe.width)} wide, all in folds"
    heights = _fitting_heights(left)
    if heights is None:
        return f"{text}, expected fewer bubbles, or a balloon that is blown up less"
    less = ", or a balloon that is blown up less" if made.length < heights[0] else ""
    return f"{text}, expected {at_least(heights[0])} to {at_most(heights[1])}{less}"


def _fitting_heights(left: OpenRound) -> tuple[float, float] | None:
    """Return the heights (m) of the lowest and the highest bubble that is twisted off what is left of a round
    balloon; None where hardly any is.
    """
    least, most = left.lengths
    lengths = np.linspace(least, most, LOBES) if least < most else np.zeros(0)
    fits = [_fitting(left, length) is not None for length in lengths]
    if not any(fits):
        return None
    first, last = fits.index(True), len(fits) - 1 - fits[::-1].index(True)
    low = _edge(left, lengths[first], lengths[max(first - 1, 0)])
    high = _edge(left, lengths[last], lengths[min(last + 1, len(fits) - 1)])
    return (low, high) if low + LEAST_RANGE < high else None


def _edge(left: OpenRound, fits: float, fails: float) -> float:
    """Return the height (m) of the bubble at which those end that fit, between two lengths of wall, m."""
    for _ in range(HALVINGS):
        middle = 0.5 * (fits + fails)
        fits, fails = (fits, middle) if _fitting(left, middle) is None else (middle, fails)
    lobe = _fitting(left, fits)
    assert lobe is not None, "the first length fits"
    return lobe.height


def _fitting(left: OpenRound, length: float) -> Lobe | None:
    """Return the bubble of a length of wall (m) that is twisted off; None where it is too flat."""
    with contextlib.suppress(ValueError):
        lobe, _ = left.parted(length)
        if lobe.width <= MOST_FLAT * lobe.height:
            return lobe
    return None


def round_volume(strip: Strip) -> float:
    """Return the volume of a round balloon that is blown up, m3."""
    share, _, _ = _shape_of(_growth(strip.size), strip.inflated_radius / strip.size.radius)
    return share * math.pi / 6.0 * (2.0 * strip.inflated_radius) ** 3


def widths_of(size: BalloonSize) -> tuple[float, float]:
    """Return the least width to which a round balloon or heart is blown up, and that of a full one, m."""
    growth = _growth(size)
    return 2.0 * growth.least * size.radius, 2.0 * growth.full * size.radius


def round_height(size: BalloonSize, width: float) -> float:
    """Return how high a round balloon or heart is that is blown up to a width, both m."""
    _, height, _ = _shape_of(_growth(size), 0.5 * width / size.radius)
    return height * width


def flat_volume(size: BalloonSize) -> float:
    """Return the volume of a flat round balloon or heart that is not pressed together, m3."""
    if size.heart:
        return size.heart_wall.volume
    return FLAT_VOLUME * 4.0 / 3.0 * math.pi * size.radius**3


def _growth(size: BalloonSize) -> Growth:
    return HEART if size.heart else EGG


def _shape_of(growth: Growth, stretch: float) -> list[float]:
    """Return volume, height and pressure of a round balloon of a width, as a growth has them."""
    known, *shapes = np.array(growth.shapes).T
    return [float(np.interp(stretch, known, shape)) for shape in shapes]
