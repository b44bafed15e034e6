"""From plans to stages: what of a plan its stage shows, and writing one from the frames of its simulation."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from balloon_usd.balloon.detail import detail_named
from balloon_usd.origin import origin_of
from balloon_usd.plan.meshing import meshes_of
from balloon_usd.plan.particles import experiment_spacing, start_particles
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.stage import AirDescription, MeshDescription, StageDescription, StageError, StageWriter

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from os import PathLike

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan, Strip
    from balloon_usd.stage import StageFrame, WrittenStage

DRAWN = 0.4
"""Diameter of a drawn air particle, in distances of neighbouring ones."""


def write_stage(
    plan: Plan,
    frames: Iterable[StageFrame],
    folder: str | PathLike[str],
    *,
    detail: str | None = None,
    flat: bool = False,
    usdz: bool = False,
    look: str | None = None,
    shot: bool = False,
) -> WrittenStage:
    """Write the frames of a plan as they come to a USD stage in a folder.

    Args:
        plan: what the frames show.
        frames: those of `simulate`, or some that follow each other.
        folder: gets NAME/NAME.usda and its payload, or one file, where NAME is the recipe's name.
        detail: level of detail of the frames; None takes that of the performance that they are, else draft.
        flat: write the one file NAME.usdc, with one look.
        usdz: write the one file NAME.usdz, with one look, y up and without textures, for AR viewers.
        look: recipe, clear, chrome, clay or stress, and thesis with the model kosaka; None takes recipe, and
            thesis where it can be.
        shot: write NAME_shot.usda beside the stage, with camera, lights and ground.

    Raises:
        StageError: the folder cannot be written, the disk is full, a frame is of another detail or plan,
            there is no such look, or the choices exclude each other.
        ValueError: there is no such level of detail.
    """
    shown = getattr(frames, "plan", plan)
    if shown is not plan and origin_of(shown) != origin_of(plan):
        raise StageError(f'the frames show another plan, that of "{shown.recipe.name}"')
    level = detail_named(getattr(frames, "detail", "draft") if detail is None else detail)
    meshes = meshes_of(plan, level)
    description, last = describe_stage(plan, meshes), None
    with StageWriter(
        description, folder, detail=level.name, flat=flat, usdz=usdz, look=look, shot=shot
    ) as writer:
        for last in frames:
            writer.write(last)
        return writer.finish(facts=_facts(plan, meshes, last))


def _facts(plan: Plan, meshes: Sequence[BalloonMesh], last: StageFrame | None) -> dict[str, int]:
    """Return what a stage says of its last frame: the same as that of a run."""
    if last is None or last.time_code != plan.frame_count:
        return {}
    return {"crossings": CrossingCounter(walls_of(plan, meshes), 1).count(last.points).count}


def describe_stage(plan: Plan, meshes: Sequence[BalloonMesh]) -> StageDescription:
    """Describe the stage of a plan, one mesh a balloon in the order of its strips."""
    recipe = plan.recipe
    return StageDescription(
        name=recipe.name,
        title=recipe.title or recipe.name,
        fps=recipe.fps,
        meshes=tuple(
            _describe_mesh(plan, strip, mesh)
            for strip, mesh in zip(plan.strips.values(), meshes, strict=True)
        ),
        bubble_names=tuple(bubble.name for bubble in plan.bubbles),
        provenance=origin_of(plan),
        twists=moves_in_time(plan),
        airs=_describe_airs(plan),
        highest_stretch=recipe.physics.traits.highest_stretch,
        lands=recipe.lands,
    )


def _describe_airs(plan: Plan) -> tuple[AirDescription, ...]:
    """Describe the air of every balloon, where the model makes it of particles."""
    physics = plan.recipe.physics
    if not physics.traits.has_air_particles:
        return ()
    found = []
    for strip in plan.strips.values():
        spacing = physics.kosaka.spacing or experiment_spacing(strip.inflated_radius)
        count = len(start_particles(strip, physics.kosaka.spacing))
        found.append(AirDescription(f"{strip.balloon}_air", count, DRAWN * spacing))
    return tuple(found)


def _describe_mesh(plan: Plan, strip: Strip, mesh: BalloonMesh) -> MeshDescription:
    balloon = plan.recipe.balloons[strip.balloon]
    color = balloon.color
    return MeshDescription(
        name=strip.balloon,
        quads=mesh.quads,
        st=mesh.st,
        quad_bubble=mesh.quad_bubble,
        bubble_names=tuple(bubble.name for bubble in strip.bubbles),
        color=color.rgb,
        material=material_name(color.name),
        finish=balloon.finish,
    )


def material_name(color: str) -> str:
    """Return the prim name of the latex of a colour, named or written as "#rrggbb"."""
    letters = re.sub(r"[^A-Za-z0-9]+", "_", color).strip("_")
    return f"latex_{letters}" if letters else "latex"


def moves_in_time(plan: Plan) -> tuple[tuple[int, str], ...]:
    """Return when the hands begin what: (time code, what), without the moments in which they only let go."""
    marks: list[tuple[int, str]] = []
    for move in plan.choreography.moves:
        if move.seconds > 0.0 and (not marks or marks[-1][1] != move.text):
            marks.append((1 + round(move.start * plan.recipe.fps), move.text))
    return tuple(marks)
