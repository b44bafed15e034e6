"""What the scheduler knows of a recipe: enough to order the work, without its plan."""

from __future__ import annotations

import stat
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.batch.looks import LOOKS, WITH_AIR

if TYPE_CHECKING:
    from collections.abc import Hashable

    from balloon_usd.batch.order import Order
    from balloon_usd.plan import Plan


@dataclass(frozen=True)
class Facts:
    """A recipe that can be made."""

    name: str
    provenance: dict[str, str]
    """Hash of the recipe's text, those of its meshes, and the version of the solver."""
    fps: float
    frames: int
    """Frames that are simulated: all up to the last one wanted."""
    written: int
    """Frames that are written."""
    vertices: int
    group: Hashable
    """Recipes of one group can advance in one simulation."""
    notices: tuple[str, ...] = ()
    cautions: tuple[str, ...] = ()
    plan: bytes = b""
    """See `reading.packed`."""


@dataclass(frozen=True)
class Refusal:
    """A recipe that cannot be made as it is."""

    problems: tuple[str, ...]
    """Lines that begin with the file and, where it is known, the place in it."""
    name: str = ""
    provenance: dict[str, str] = field(default_factory=dict)


def survey(file: str, order: Order) -> Facts | Refusal:
    """Read and plan a recipe, and say what it takes or why it is refused."""
    from balloon_usd.plan import plan  # noqa: PLC0415
    from balloon_usd.recipe import Recipe, RecipeError  # noqa: PLC0415

    if _is_pipe_or_device(Path(file)):
        # It would be waited for, and can be read only once.
        return Refusal((f"{file}:1:1: cannot be read (it is a pipe or a device), expected a recipe file",))
    try:
        planned = plan(Recipe.load(Path(file)))
    except RecipeError as error:
        return Refusal(tuple(str(error).splitlines()))
    return _judge(planned, order)


def _is_pipe_or_device(file: Path) -> bool:
    try:
        kind = file.stat().st_mode
    except (OSError, ValueError):
        return False
    return not (stat.S_ISREG(kind) or stat.S_ISDIR(kind))


def _judge(plan: Plan, order: Order) -> Facts | Refusal:
    from balloon_usd.balloon.detail import detail_named  # noqa: PLC0415
    from balloon_usd.batch.reading import packed  # noqa: PLC0415
    from balloon_usd.origin import origin_of  # noqa: PLC0415
    from balloon_usd.plan.meshing import made_meshes  # noqa: PLC0415

    recipe = plan.recipe
    name, provenance = recipe.name, origin_of(plan)
    problems = order.in_the_way(name)
    if order.look == WITH_AIR and not recipe.physics.traits.has_air_particles:
        needs = f"needs model: kosaka, take one of {', '.join(LOOKS)}"
        problems.append(f"{recipe.file}: --look {WITH_AIR} {needs}")
    try:
        codes = order.frames.within(plan.frame_count)
    except ValueError as error:
        problems.append(f"{recipe.file}: {error}")
    if problems:
        return Refusal(tuple(problems), name, provenance)
    level = detail_named(order.detail)
    return Facts(
        name,
        provenance,
        recipe.fps,
        codes[-1],
        len(codes),
        sum(len(mesh.points) for mesh in made_meshes(plan, level)),
        _group(plan),
        tuple(map(str, recipe.notices)),
        tuple(_cautions(plan)),
        packed(plan),
    )


def _group(plan: Plan) -> tuple[str, ...]:
    """Return what plans that advance together have in common: frame rate and surrounding physics."""
    own = {"hold", "leak", "rubber", "softening", "kosaka"}
    physics = plan.recipe.physics.model_dump(exclude=own)
    return (str(plan.recipe.fps), *(f"{key}={value}" for key, value in physics.items()))


def _cautions(plan: Plan) -> list[str]:
    lines = []
    for caution in plan.cautions:
        place = "" if caution.step is None else f"step {caution.step + 1}: "
        lines.append(f"{plan.recipe.file}: caution: {place}{caution.what} ({caution.why})")
    return lines
