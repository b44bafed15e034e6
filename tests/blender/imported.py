"""A stage as Blender shows it: objects by the paths of their prims, and numbers as arrays."""

from __future__ import annotations

import re
from pathlib import Path

import bpy
import numpy as np

KINDS = {
    "FLOAT": (np.float32, 1, "value"),
    "INT": (np.int32, 1, "value"),
    "FLOAT2": (np.float32, 2, "vector"),
    "FLOAT_VECTOR": (np.float32, 3, "vector"),
    "FLOAT_COLOR": (np.float32, 4, "color"),
}
"""Of each type of attribute: number, numbers in an element, and where Blender keeps them."""


def import_stage(file: Path) -> dict[str, bpy.types.Object]:
    """Import into an empty file; objects by the path of the prim that they were."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    # A dome light changes the world that is there.
    world = bpy.context.scene.world = bpy.data.worlds.new("world")
    world.use_nodes = True
    bpy.ops.wm.usd_import(filepath=str(file))
    return {path_of(thing): thing for thing in bpy.context.scene.objects}


def path_of(thing: bpy.types.Object) -> str:
    """The path of the prim that an object was; Blender numbers names that it has already."""
    above = path_of(thing.parent) if thing.parent else ""
    return f"{above}/{prim_name(thing.name)}"


def prim_name(name: str) -> str:
    """The name without Blender's number."""
    return re.sub(r"\.\d{3}$", "", name)


def show_frame(frame: int) -> bpy.types.Depsgraph:
    """Go to a frame and return what is evaluated there."""
    bpy.context.scene.frame_set(frame)
    return bpy.context.evaluated_depsgraph_get()


def attributes_of(
    thing: bpy.types.Object, graph: bpy.types.Depsgraph
) -> dict[str, tuple[str, str, np.ndarray]]:
    """Domain, type and values (N, components) of each attribute of an evaluated mesh or point cloud."""
    return {
        attribute.name: (attribute.domain, attribute.data_type, values_of(attribute))
        for attribute in thing.evaluated_get(graph).data.attributes
        if attribute.data_type in KINDS
    }


def values_of(attribute: bpy.types.Attribute) -> np.ndarray:
    """Values (N, components)."""
    number, components, key = KINDS[attribute.data_type]
    values = np.empty(len(attribute.data) * components, dtype=number)
    attribute.data.foreach_get(key, values)
    return values.reshape(-1, components)


def topology_of(thing: bpy.types.Object, graph: bpy.types.Depsgraph) -> tuple[np.ndarray, np.ndarray]:
    """Corners of each face (F,) and the vertices at them (C,), of an evaluated mesh."""
    mesh = thing.evaluated_get(graph).data
    counts = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("loop_total", counts)
    corners = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    return counts, corners
