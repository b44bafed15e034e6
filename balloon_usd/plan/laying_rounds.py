"""Round balloons: one bubble each, blown up to a width."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.ball_pressure import ball_pressure
from balloon_usd.language.lengths import at_least, at_most, cm
from balloon_usd.language.problem import RecipeError
from balloon_usd.plan.strip import PlannedBubble, Strip

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.recipe import Recipe

FULL = 5.0
"""Width of a full round balloon, in that of the flat one: one of 5 inches is 13 cm wide."""
BEYOND_FULL = 1.02
"""A width beyond the full one by this share means full: nominal widths are rounded."""
LEAST = 1.3
"""Least width to which one is blown up, in that of the flat one: below, its wall is hardly stretched."""
SHAPES = (
    (1.34, 1.40, 1.38, 0.72),
    (1.84, 1.14, 1.155, 0.93),
    (2.38, 1.017, 1.043, 1.00),
    (2.93, 0.994, 1.010, 1.005),
    (3.44, 1.020, 1.020, 0.975),
    (3.90, 1.074, 1.058, 0.925),
    (4.36, 1.122, 1.105, 0.873),
    (4.82, 1.164, 1.151, 0.83),
    (5.04, 1.185, 1.171, 0.815),
)
"""Shapes of one by its width, in that of the flat one: its volume, in that of a ball as wide, its height, in
its width, and its pressure, in that of such a ball. Measured in simulations of both sizes in `preview`, which
differ from these by 2 %. It is a pear at first, nearly a ball when half full, and a pear again when full.
"""
FLAT_VOLUME = 1.9
"""Volume of a flat one that is not pressed together, in that of a ball of its width."""


def round_strip(recipe: Recipe, name: str, size: BalloonSize, rubber: Rubber) -> Strip:
    """Return the strip of a round balloon: one bubble, as wide as the recipe says.

    Raises:
        RecipeError: it cannot be blown up to that width.
    """
    flat = 2.0 * size.radius
    full = FULL * flat
    balloon = recipe.balloons[name]
    key, width = "inflated", full if balloon.inflated is None else balloon.inflated
    if balloon.filled is not None:
        key, width = "filled", 0.01 * balloon.filled * full
    if not LEAST * flat <= width <= BEYOND_FULL * full:
        text = f"a round balloon {cm(flat)} wide while it is flat is not blown up to {cm(width)}"
        text += f", expected a width of {at_least(LEAST * flat)} to {at_most(full)}"
        raise RecipeError([recipe.problem(("balloons", name, key), text)])
    volume, height, pressure = _shape_of(width / flat)
    bubble = recipe.piece.row(name)[-1]
    planned = PlannedBubble(
        name=bubble,
        balloon=name,
        kind="rest",
        length=height * width,
        start=0.0,
        end=height * width,
        rest_start=0.0,
        rest_end=size.length,
        volume=volume * math.pi / 6.0 * width**3,
        step=recipe.piece.bubbles[bubble].step,
        pressure=pressure * ball_pressure(rubber, width / flat, size.thickness / size.radius),
    )
    return Strip(name, size, rubber, 0.0, (planned,), width=width)


def round_volume(strip: Strip) -> float:
    """Return the volume of a round balloon that is blown up, m3."""
    share, _, _ = _shape_of(strip.inflated_radius / strip.size.radius)
    return share * math.pi / 6.0 * (2.0 * strip.inflated_radius) ** 3


def _shape_of(stretch: float) -> list[float]:
    """Return volume, height and pressure of a round balloon of a width, as in `SHAPES`."""
    known, *shapes = np.array(SHAPES).T
    return [float(np.interp(stretch, known, shape)) for shape in shapes]
