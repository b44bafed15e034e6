"""Balloons of any closed shape, from mesh files: one bubble each, blown up as a whole."""

from __future__ import annotations

import hashlib
import math
from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.balloon.ball_pressure import ball_pressure
from balloon_usd.balloon.closed_shape import ClosedShape
from balloon_usd.balloon.sizes import BalloonSize
from balloon_usd.language.lengths import cm
from balloon_usd.language.problem import RecipeError
from balloon_usd.language.quantities import METRES
from balloon_usd.plan.shaped import Shaped
from balloon_usd.plan.strip import PlannedBubble, Strip
from balloon_usd.recipe.balloons import USUAL_SWELL

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.language.problem import Problem
    from balloon_usd.recipe import Recipe

WALL = 0.25e-3
"""Wall of a balloon from a mesh, if the recipe does not say, m: that of a party balloon."""
SMALLEST, LARGEST = 0.02, 3.0
"""Longest side of the box round a flat balloon, m."""
LIKELY_SMALLEST, LIKELY_LARGEST = 0.05, 2.0
"""Longest side of what artists usually model, m."""
THICKEST = 0.05
"""Thickness of a wall in radii of a ball of it, up to which it bends and stretches as a membrane."""
APART = 0.01
"""Distance between the boxes of two balloons, m."""
LEAST_AIR = 1.05
"""Volume when blown up, in that of the shape before."""
USUAL_VOLUME, USUAL_SECONDS = 2.0e-3, 2.0
"""Volume (m3) that is blown in within so long (s), or less; more of it takes longer as balloons grow."""


def shaped_strip(recipe: Recipe, name: str, rubber: Rubber) -> Strip:
    """Return the strip of a balloon from a mesh file: one bubble, named as the balloon.

    Raises:
        RecipeError: the file cannot be read or makes no balloon, or its size or the swell is not plausible.
    """
    balloon = recipe.balloons[name]
    surface, sha256 = _surface(recipe, name)
    thickness, swell = balloon.thickness or WALL, balloon.swell or USUAL_SWELL
    if thickness > THICKEST * surface.ball_radius:
        text = f"a wall of {1e3 * thickness:g} mm is no thin skin of a balloon of {cm(max(surface.size))}"
        most = f"expected at most {math.floor(1e5 * THICKEST * surface.ball_radius) / 100.0:g} mm"
        raise RecipeError([recipe.problem(("balloons", name, "thickness"), f"{text}, {most}")])
    volume = swell**3 * surface.ball_volume
    least = (LEAST_AIR * surface.start.volume / surface.ball_volume) ** (1 / 3)
    if swell < least:
        text = f"{swell:g} is less than {name} holds before it is blown up"
        text += f", expected at least {math.ceil(100.0 * least) / 100.0:g}"
        raise RecipeError([recipe.problem(("balloons", name, "swell"), text)])
    shape = Shaped(
        surface,
        sha256,
        swell,
        volume,
        ball_pressure(rubber, swell, thickness / surface.ball_radius),
        USUAL_SECONDS * max(1.0, (volume / USUAL_VOLUME) ** (1 / 3)),
    )
    longest = max(surface.size)
    size = BalloonSize("mesh", surface.ball_radius, longest, thickness)
    bubble = PlannedBubble(
        name=name,
        balloon=name,
        kind="shape",
        length=longest,
        start=0.0,
        end=longest,
        rest_start=0.0,
        rest_end=longest,
        volume=volume,
        step=len(recipe.steps),
    )
    return Strip(name, size, rubber, 0.0, (bubble,), shape=shape)


def overlap_problems(recipe: Recipe, strips: Mapping[str, Strip]) -> Iterator[Problem]:
    """Yield the balloons from meshes that lie in the box of one before them, if not put into it: walls must
    start apart.
    """
    shapes = [
        (name, strip.shape.surface)
        for name, strip in strips.items()
        if strip.shape is not None and strip.inside is None
    ]
    free = max((float(surface.box[1][0]) for _, surface in shapes), default=0.0)
    for at, (name, surface) in enumerate(shapes):
        met = [one for one, other in shapes[:at] if surface.meets(other)]
        if not met:
            continue
        least, most = surface.box
        x, y, z = recipe.balloons[name].at or (0.0, 0.0, 0.0)
        beside = math.ceil(1e3 * (x + free + APART - float(least[0]))) / 1e3
        free = beside - x + float(most[0])
        place = ", ".join(f"{round(100.0 * value, 4):g} cm" for value in (beside, y, z))
        text = f"lies where {met[0]} is, expected its box beside that, such as at: [{place}]"
        yield recipe.problem(("balloons", name), text)


def _surface(recipe: Recipe, name: str) -> tuple[ClosedShape, str]:
    """Read the shape of a balloon, and the hash of its file."""
    # Recipes of tubes need no library for meshes.
    from balloon_usd.mesh_file.error import MeshFileError  # noqa: PLC0415
    from balloon_usd.mesh_file.read_shape import read_shape  # noqa: PLC0415

    balloon, path = recipe.balloons[name], ("balloons", name, "mesh")
    unit = balloon.unit or recipe.units
    if unit is None:
        text = "has no unit, expected unit: m beside it, or units: cm at the top of the recipe"
        raise RecipeError([recipe.problem(path, text)])
    file = Path(recipe.file).parent / str(balloon.mesh)
    try:
        shape = read_shape(file, float(METRES[unit]))
        content = file.read_bytes()
    except (MeshFileError, OSError) as error:
        raise RecipeError([recipe.problem(path, f"{file}: {error}")]) from error
    longest = max(shape.size)
    if not SMALLEST <= longest <= LARGEST:
        text = f"{file}: {_shown(longest)} long in {unit}, expected {_shown(SMALLEST)} to {_shown(LARGEST)}"
        raise RecipeError([recipe.problem(path, text + _likely_unit(longest / float(METRES[unit])))])
    place = balloon.at or (0.0, 0.0, 0.0)
    return ClosedShape(shape.points + place, shape.quads), hashlib.sha256(content).hexdigest()


def _shown(length: float) -> str:
    return cm(length) if length < 1.0 else f"{length:.3g} m"


def _likely_unit(length: float) -> str:
    """Say in which unit a length would be that of a balloon."""
    for unit in ("mm", "cm", "m", "in"):
        if LIKELY_SMALLEST <= length * float(METRES[unit]) <= LIKELY_LARGEST:
            return f": is its unit {unit}?"
    return ""
