# SPDX-FileCopyrightText: 2026 balloon_usd maintainers
# SPDX-License-Identifier: GPL-3.0-or-later
"""A stage arrives in the scene: frame rate and range, smooth surfaces, one figure of each stage."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any, NamedTuple

import bpy

TAG = "balloon_usd_stage"
"""Custom property of every imported object: the file that it came from."""
VIEWPORT_LEVELS, RENDER_LEVELS = 1, 2
SUBDIVISION = ("import_subdivision", "import_subdiv")
"""The importer's option that brings the modifier: since Blender 5.0, and before."""
_RATE = re.compile(r"^\s*framesPerSecond = ([0-9.eE+-]+)\s*$", re.MULTILINE)


class Arrived(NamedTuple):
    """What was imported."""

    name: str
    frames: int
    fps: float


def bring_in(stage: Path) -> Arrived:
    """Import a stage, in place of an earlier import of the same file, and set the scene's time.

    Raises:
        RuntimeError: Blender cannot read the file.
        OSError: there is no such file.
    """
    scene, stage = bpy.context.scene, stage.resolve(strict=True)
    fps = frame_rate(stage)
    place = _take_out(stage)
    before = {*bpy.data.objects}
    _usd_import(stage)
    things = [thing for thing in bpy.data.objects if thing not in before]
    for thing in things:
        thing[TAG] = str(stage)
        if thing.type == "MESH":
            _smooth(thing)
        if thing.type == "POINTCLOUD" and not thing.data.materials:
            thing.data.materials.append(_colored_by_attribute())
    if place is not None:
        _root_of(things).matrix_basis = place
    scene.render.fps = max(1, math.ceil(fps))
    scene.render.fps_base = scene.render.fps / fps
    scene.frame_set(scene.frame_start)
    return Arrived(stage.stem, scene.frame_end - scene.frame_start + 1, fps)


def frame_rate(stage: Path) -> float:
    """Return the frames per second that the head of a text stage names; Blender's importer ignores them.

    Raises:
        RuntimeError: it names none.
    """
    match = _RATE.search(stage.read_text(encoding="utf-8"))
    if match is None:
        raise RuntimeError(f"{stage}: no framesPerSecond")
    return float(match[1])


def _usd_import(stage: Path) -> None:
    known = bpy.ops.wm.usd_import.get_rna_type().properties.keys()
    option = next(name for name in SUBDIVISION if name in known)
    bpy.ops.wm.usd_import(filepath=str(stage), create_collection=True, **{option: True})


def _smooth(thing: Any) -> None:
    thing.data.shade_smooth()
    for modifier in thing.modifiers:
        if modifier.type == "SUBSURF":
            modifier.levels, modifier.render_levels = VIEWPORT_LEVELS, RENDER_LEVELS


def _colored_by_attribute() -> Any:
    """A material that shows each particle of air in its own colour: the importer brings points none."""
    material = bpy.data.materials.new("air")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    color = nodes.new("ShaderNodeAttribute")
    color.attribute_name = "displayColor"
    surface = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    material.node_tree.links.new(color.outputs["Color"], surface.inputs["Base Color"])
    return material


def _take_out(stage: Path) -> Any:
    """Remove an earlier import of the file and return its place, or None.

    Blender goes on reading the earlier samples as long as it holds the file open.
    """
    things = [thing for thing in bpy.data.objects if thing.get(TAG) == str(stage)]
    place = _root_of(things).matrix_basis.copy() if things else None
    homes = {home for thing in things for home in thing.users_collection}
    data = {thing.data for thing in things if thing.data}
    materials = {slot.material for thing in things for slot in thing.material_slots if slot.material}
    bpy.data.batch_remove(things)
    for used in (data, materials):
        bpy.data.batch_remove([each for each in used if each.users == 0])
    bpy.data.batch_remove([home for home in homes if not home.all_objects and not home.children])
    _let_go(stage)
    return place


def _let_go(stage: Path) -> None:
    """Close the file; what else was imported from it reads it anew."""
    files = [file for file in bpy.data.cache_files if _path(file) == stage]
    bpy.data.batch_remove([file for file in files if file.users == 0])
    for file in bpy.data.cache_files:
        if _path(file) == stage:
            with bpy.context.temp_override(edit_cachefile=file):
                bpy.ops.cachefile.reload()


def _path(file: Any) -> Path:
    return Path(bpy.path.abspath(file.filepath)).resolve()


def _root_of(things: list[Any]) -> Any:
    return next(thing for thing in things if thing.parent not in things)
