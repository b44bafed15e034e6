"""Wire and air: the materials of the look of Kosaka 2008, chapter 4."""

from __future__ import annotations

from typing import Any

from pxr import Gf, Sdf, UsdGeom, UsdShade

from balloon_usd.stage.looks import WITHIN_QUAD
from balloon_usd.stage.wire_texture import CUT, FILE_NAME

WIRE, AIR = "wire", "air"
"""Prim names of the materials."""

WIRE_COLOR = (0.871, 0.216, 0.005)
"""Linear rgb: orange, as the springs are drawn in the thesis."""
MATT = 1.0
"""Roughness of a line, which must not shine."""
AIR_ROUGHNESS = 0.4


def author_wire_material(stage: Any, path: Any) -> Any:
    """A matt surface that a texture cuts away but for the edges of each quad."""
    material, surface = _preview_surface(stage, path)
    surface.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*WIRE_COLOR))
    surface.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(MATT)
    surface.CreateInput("opacityThreshold", Sdf.ValueTypeNames.Float).Set(CUT)
    place = _primvar(stage, path.AppendChild("place"), "float2", WITHIN_QUAD, Sdf.ValueTypeNames.Float2)
    texture = UsdShade.Shader.Define(stage, path.AppendChild("texture"))
    texture.CreateIdAttr("UsdUVTexture")
    texture.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(Sdf.AssetPath(f"./{FILE_NAME}"))
    texture.CreateInput("sourceColorSpace", Sdf.ValueTypeNames.Token).Set("raw")
    for wrap in ("wrapS", "wrapT"):
        texture.CreateInput(wrap, Sdf.ValueTypeNames.Token).Set("clamp")
    texture.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(place)
    grey = texture.CreateOutput("r", Sdf.ValueTypeNames.Float)
    surface.CreateInput("opacity", Sdf.ValueTypeNames.Float).ConnectToSource(grey)
    return material


def author_air_material(stage: Any, path: Any) -> Any:
    """A plain surface in the colour of each particle."""
    material, surface = _preview_surface(stage, path)
    color = _primvar(
        stage,
        path.AppendChild("color"),
        "float3",
        UsdGeom.Primvar.StripPrimvarsName(UsdGeom.Tokens.primvarsDisplayColor),
        Sdf.ValueTypeNames.Float3,
    )
    surface.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).ConnectToSource(color)
    surface.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(AIR_ROUGHNESS)
    return material


def _preview_surface(stage: Any, path: Any) -> tuple[Any, Any]:
    material = UsdShade.Material.Define(stage, path)
    surface = UsdShade.Shader.Define(stage, path.AppendChild("preview"))
    surface.CreateIdAttr("UsdPreviewSurface")
    out = surface.CreateOutput("surface", Sdf.ValueTypeNames.Token)
    material.CreateSurfaceOutput().ConnectToSource(out)
    return material, surface


def _primvar(stage: Any, path: Any, kind: str, name: str, type_name: Any) -> Any:
    """A shader that reads a primvar; returns its output."""
    reader = UsdShade.Shader.Define(stage, path)
    reader.CreateIdAttr(f"UsdPrimvarReader_{kind}")
    reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set(name)
    return reader.CreateOutput("result", type_name)
