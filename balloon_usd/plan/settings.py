"""Settings with which no run can work: each is refused with the reason and a value that does.

The recipe's own ranges catch what makes no sense by itself. Here is what depends on two entries, or on the
size of a balloon. Limits were measured: beyond them balloons shrink, tremble or fly apart.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.language.quantities import duration_entry
from balloon_usd.plan.holding import hold_seconds
from balloon_usd.plan.settings_kosaka import kosaka_problems
from balloon_usd.recipe.physics import MOST_SUBSTEPS

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.balloon.sizes import BalloonSize
    from balloon_usd.language.problem import Problem
    from balloon_usd.recipe import Recipe

THICKEST = 0.25
"""Thickness of a wall in radii of its tube, up to which it bends and stretches as a membrane."""
WAVE = 200.0
"""Radii of the tube times time steps in a second that unscaled masses need at least, m/s: in that time a
wave must not cross a face of the draft mesh.
"""
SLOWEST = 400.0
"""Time steps in a second with which scaled masses still follow the hands."""
LEAK_IN_A_SECOND = 86400.0
"""Time of leaking that one second of the hold may stand for, s: in a day a 260 loses half of its gas."""


def settings_problems(recipe: Recipe, tubes: Mapping[str, BalloonSize]) -> list[Problem]:
    """Return what is wrong with the physics and the balloons of a recipe, at its places in the file.

    `tubes`: sizes of its tubes, by balloon.
    """
    if recipe.physics.model == "kosaka":
        return kosaka_problems(recipe, tubes)
    return [
        *_thick_walls(recipe, tubes),
        *_slow_steps(recipe),
        *_unscaled_masses(recipe, tubes),
        *_hasty_leak(recipe),
    ]


def _thick_walls(recipe: Recipe, tubes: Mapping[str, BalloonSize]) -> Iterator[Problem]:
    for name, size in tubes.items():
        if size.thickness > THICKEST * size.neck_radius * (1.0 + 1e-9):
            key = "radius" if recipe.balloons[name].thickness is None else "thickness"
            # Rounded to hundredths of a millimetre, so that what is written works.
            part = "tube" if size.neck is None else "neck"
            wider = size.radius / size.neck_radius
            least = math.ceil(1e5 * wider * size.thickness / THICKEST - 1e-6) / 100.0
            most = math.floor(1e5 * size.neck_radius * THICKEST + 1e-6) / 100.0
            expected = f"at least {least:g} mm" if key == "radius" else f"at most {most:g} mm"
            text = (
                f"a wall of {1e3 * size.thickness:g} mm is no thin skin round a "
                f"{part} of {1e3 * size.neck_radius:g} mm radius, expected {expected}"
            )
            yield recipe.problem(("balloons", name, key), text)


def _slow_steps(recipe: Recipe) -> Iterator[Problem]:
    given, least = recipe.physics.substeps, math.ceil(SLOWEST / recipe.fps)
    if recipe.physics.mass_scaling == "none":
        return
    if given is not None and given < least:
        text = (
            f"{given} at {recipe.fps:g} frames/s are too few to follow the hands, expected at least {least}"
        )
        yield recipe.problem(("physics", "substeps"), text)


def _unscaled_masses(recipe: Recipe, tubes: Mapping[str, BalloonSize]) -> Iterator[Problem]:
    physics = recipe.physics
    if physics.mass_scaling != "none":
        return
    radius = min(size.neck_radius for size in tubes.values())
    needed = 50 * math.ceil(WAVE / radius / recipe.fps / 50.0)
    if (physics.substeps or 0) >= needed:
        return
    selective, least = "mass_scaling: selective", math.ceil(SLOWEST / recipe.fps)
    if physics.substeps is not None and physics.substeps < least:
        selective += f" and substeps: {least}"
    if needed > MOST_SUBSTEPS:
        more_frames = math.ceil(WAVE / radius / MOST_SUBSTEPS)
        expected = f"{selective}, or fps: {more_frames} and substeps: {MOST_SUBSTEPS}"
    else:
        expected = f"substeps: {needed} or more (finer details need more), or {selective}"
    given = "the usual time steps" if physics.substeps is None else f"{physics.substeps} substeps"
    text = f"{given} are too long for rubber of its true mass, expected {expected}"
    key = "mass_scaling" if physics.substeps is None else "substeps"
    yield recipe.problem(("physics", key), text)


def _hasty_leak(recipe: Recipe) -> Iterator[Problem]:
    leak = recipe.physics.leak
    if leak is None or leak <= LEAK_IN_A_SECOND * (hold := hold_seconds(recipe)):
        return
    needed = f"hold: {math.ceil(leak / LEAK_IN_A_SECOND)}"
    most = f", or leak: {duration_entry(LEAK_IN_A_SECOND * hold)}" if hold > 0.0 else ""
    text = f"{duration_entry(leak)} in a hold of {hold:g} s are too fast to follow, expected {needed}{most}"
    yield recipe.problem(("physics", "leak"), text)
