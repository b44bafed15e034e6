"""Materials and the sky: what a UsdPreviewSurface says against the Principled BSDF that Blender made of it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import bpy
import numpy as np
from pxr import Usd, UsdLux, UsdShade

from tests.blender.imported import prim_name

SOCKETS = {
    "diffuseColor": "Base Color",
    "emissiveColor": "Emission Color",
    "metallic": "Metallic",
    "roughness": "Roughness",
    "clearcoat": "Coat Weight",
    "clearcoatRoughness": "Coat Roughness",
    "opacity": "Alpha",
    "ior": "IOR",
}
"""Inputs of the preview surface and the sockets that take them."""
ELSEWHERE = {"opacityThreshold", "useSpecularWorkflow", "opacityMode"}
"""Inputs that Blender turns into something else than a value of a socket."""
READERS = {
    "UsdPrimvarReader_float": ("ATTRIBUTE", "attribute_name"),
    "UsdPrimvarReader_float3": ("ATTRIBUTE", "attribute_name"),
    "UsdPrimvarReader_float2": ("UVMAP", "uv_map"),
}
"""Shaders that read a primvar: Blender's node, and where it keeps the name."""


def surface_differences(prim: Usd.Prim, thing: bpy.types.Object) -> Iterator[str]:
    """What differs between the material bound to a mesh and that of its object."""
    bound, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    slots = [slot.material for slot in thing.material_slots]
    if not bound or len(slots) != 1 or slots[0] is None:
        yield f"material is {bound.GetPath()}, in Blender {slots}"
        return
    if prim_name(slots[0].name) != bound.GetPrim().GetName():
        yield f"material is {bound.GetPrim().GetName()}, in Blender {slots[0].name}"
    nodes = [node for node in slots[0].node_tree.nodes if node.type == "BSDF_PRINCIPLED"]
    preview = bound.ComputeSurfaceSource()[0]
    if len(nodes) != 1 or preview.GetIdAttr().Get() != "UsdPreviewSurface":
        yield f"{bound.GetPath()}: no preview surface, or in Blender no Principled BSDF"
        return
    for given in preview.GetInputs():
        for text in _input_differences(given, nodes[0]):
            yield f"{bound.GetPath()}: {given.GetBaseName()} {text}"


def dome_differences(dome: UsdLux.DomeLight) -> Iterator[str]:
    """What differs between a dome light without a texture and the world."""
    background = bpy.context.scene.world.node_tree.nodes["Background"]
    written = [dome.GetIntensityAttr().Get(), *dome.GetColorAttr().Get()]
    inputs = background.inputs
    shown = [inputs["Strength"].default_value, *inputs["Color"].default_value[:3]]
    if not np.array_equal(np.float32(written), np.float32(shown)):
        yield f"intensity and color are {written}, in Blender {shown}"


def _input_differences(given: UsdShade.Input, node: bpy.types.Node) -> Iterator[str]:
    name = given.GetBaseName()
    if name in ELSEWHERE:
        return
    if name not in SOCKETS:
        yield "does not arrive in Blender"
        return
    socket = node.inputs[SOCKETS[name]]
    if given.HasConnectedSource():
        source = given.GetConnectedSources()[0][0].source
        yield from _source_differences(UsdShade.Shader(source), socket)
    elif socket.is_linked:
        yield "has a value, in Blender a link"
    else:
        value = np.atleast_1d(np.asarray(given.Get(), dtype=np.float32))
        shown = np.atleast_1d(np.asarray(socket.default_value, dtype=np.float32))[: len(value)]
        passed = 1.0 - np.float32(node.inputs["Transmission Weight"].default_value)
        let_through = name == "opacity" and shown == 1.0 and np.allclose(value, passed, rtol=0.0, atol=1e-7)
        # What is not opaque is glass since Blender 5.2, and a veil before.
        if not np.array_equal(value, shown) and not let_through:
            yield f"is {value}, in Blender {shown}"


def _source_differences(shader: UsdShade.Shader, socket: bpy.types.NodeSocket) -> Iterator[str]:
    """What differs between the shader that an input is connected to and the nodes behind a socket."""
    kind = shader.GetIdAttr().Get()
    behind = {node.type: node for node in _behind(socket)}
    if kind in READERS:
        node, key = READERS[kind]
        read = shader.GetInput("varname").Get()
        if node not in behind or getattr(behind[node], key) != read:
            yield f"reads {read}, in Blender there are {sorted(behind)}"
    elif kind == "UsdUVTexture":
        file = shader.GetInput("file").Get().resolvedPath
        image = behind["TEX_IMAGE"].image if "TEX_IMAGE" in behind else None
        if image is None or Path(file).name != Path(image.filepath).name or image.size[0] == 0:
            yield f"is the texture {file}, in Blender {image}"
        yield from _source_differences(
            UsdShade.Shader(shader.GetInput("st").GetConnectedSources()[0][0].source),
            behind["TEX_IMAGE"].inputs["Vector"],
        )
    else:
        yield f"comes from {kind}, which Blender does not read"


def _behind(socket: bpy.types.NodeSocket) -> Iterator[bpy.types.Node]:
    """Nodes whose values reach a socket."""
    for link in socket.links:
        yield link.from_node
        for other in link.from_node.inputs:
            yield from _behind(other)
