"""Round balloons and hearts, blown up to a width."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.balloon.ball_pressure import ball_pressure
from balloon_usd.language.lengths import at_least, at_most, cm
from balloon_usd.language.problem import RecipeError
from balloon_usd.plan.open_tube import MILLIMETRE
from balloon_usd.plan.overblowing import bursting_width, softened_by
from balloon_usd.plan.strip import BlownRound, PlannedBubble, Strip
from balloon_usd.plan.twisting_rounds import twisted_bubbles

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.balloon.rubber import MembraneLaw, Rubber
    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.plan.strip import Made
    from balloon_usd.recipe import Recipe
    from balloon_usd.recipe.balloons import Balloon

BEYOND_FULL = 1.02
"""A width beyond the full one by this share means full: nominal widths are rounded."""
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
        (5.10, 1.185, 1.171, 0.815),
        (5.35, 1.24, 1.205, 0.80),
        (5.70, 1.265, 1.225, 0.785),
        (6.05, 1.285, 1.245, 0.775),
        (7.00, 1.325, 1.280, 0.755),
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
    bubbles = twisted_bubbles(recipe, rest, size, rubber, blown, twisted) if twisted else (rest,)
    return Strip(name, size, rubber, 0.0, bubbles, blown=blown)


def _blown(recipe: Recipe, name: str, size: BalloonSize, rubber: Rubber) -> BlownRound:
    """What a round balloon or a heart is blown up to."""
    least, full = widths_of(size)
    balloon = recipe.balloons[name]
    key, width = "inflated", full if balloon.inflated is None else balloon.inflated
    if balloon.filled is not None:
        key, width = "filled", 0.01 * balloon.filled * full
    if not least <= width <= BEYOND_FULL * full:
        text = f"{_what(size)} is not blown up to {cm(width)}"
        text += f", expected a width of {at_least(least)} to {at_most(full)}"
        raise RecipeError([recipe.problem(("balloons", name, key), text)])
    before = balloon.overblown
    if before is None:
        return _round_of(size, rubber, width)
    if text := _misblown(size, rubber, balloon, width):
        raise RecipeError([recipe.problem(("balloons", name, "overblown"), text)])
    softer = _round_of(size, softened_by(rubber, size, before), width)
    return softer._replace(before=_round_of(size, rubber, before))


def _misblown(size: BalloonSize, rubber: Rubber, balloon: Balloon, width: float) -> str:
    """Say why a round balloon or a heart is not blown up farther before it is let down to a width, m; nothing
    where it is.
    """
    before = balloon.overblown
    assert before is not None, "it is blown up farther"
    least, most = width + MILLIMETRE, widths_of(size)[1] if size.heart else bursting_width(rubber, size)
    if least > most:
        text = f"{_what(size)} is full at {cm(width)}, and not blown up farther"
        return f"{text}, expected inflated: less than that"
    expected = f"expected {at_least(least)} to {at_most(most)}"
    if before < least:
        full = balloon.inflated is None and balloon.filled is None
        down = f"its full width of {cm(width)}" if full else cm(width)
        less = ", or inflated: less than that" if full else ""
        return f"air is let out down to {down}, which {cm(before)} is not above, {expected}{less}"
    if before > most:
        bursts = "which tears it in its cleft" if size.heart else "at which it bursts"
        return f"{_what(size)} is not blown up to {cm(before)}, {bursts}, {expected}"
    return ""


def _what(size: BalloonSize) -> str:
    what = "heart" if size.heart else "round balloon"
    return f"a {what} {cm(2.0 * size.radius)} wide while it is flat"


def _round_of(size: BalloonSize, rubber: MembraneLaw, width: float) -> BlownRound:
    """Return a round balloon or a heart of a width, m."""
    stretch, thinness = 0.5 * width / size.radius, size.thickness / size.radius
    pressure = _shape_of(size, width)[2] * ball_pressure(rubber, stretch, thinness)
    return BlownRound(width, round_height(size, width), round_volume(size, width), pressure)


def round_volume(size: BalloonSize, width: float) -> float:
    """Return the volume (m3) of a round balloon or heart that is blown up to a width, m."""
    share, _, _ = _shape_of(size, width)
    return share * math.pi / 6.0 * width**3


def widths_of(size: BalloonSize) -> tuple[float, float]:
    """Return the least width to which a round balloon or heart is blown up, and that of a full one, m."""
    growth = _growth(size)
    return 2.0 * growth.least * size.radius, 2.0 * growth.full * size.radius


def round_height(size: BalloonSize, width: float) -> float:
    """Return how high a round balloon or heart is that is blown up to a width, both m."""
    _, height, _ = _shape_of(size, width)
    return height * width


def flat_volume(size: BalloonSize) -> float:
    """Return the volume of a flat round balloon or heart that is not pressed together, m3."""
    if size.heart:
        return size.heart_wall.volume
    return FLAT_VOLUME * 4.0 / 3.0 * math.pi * size.radius**3


def _growth(size: BalloonSize) -> Growth:
    return HEART if size.heart else EGG


def _shape_of(size: BalloonSize, width: float) -> list[float]:
    """Return volume, height and pressure of a round balloon of a width, m, as its growth has them."""
    known, *shapes = np.array(_growth(size).shapes).T
    return [float(np.interp(0.5 * width / size.radius, known, shape)) for shape in shapes]
