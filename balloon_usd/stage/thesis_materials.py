"""Wire: the material of the rubber in the look of Kosaka 2008, chapter 4."""

from __future__ import annotations

from typing import Any

from balloon_usd.openusd import Gf, Sdf, UsdShade
from balloon_usd.stage.looks import WITHIN_QUAD
from balloon_usd.stage.shaders import preview_surface, primvar_reader
from balloon_usd.stage.wire_texture import CUT, FILE_NAME

WIRE_COLOR = (0.871, 0.216, 0.005)
"""Linear rgb: orange, as the springs are drawn in the thesis."""
MATT = 1.0
"""Roughness of a line, which must not shine."""


def author_wire_material(stage: Any, path: Any) -> Any:
    """A matt surface that a texture cuts away but for the edges of each quad."""
    material, surface = preview_surface(stage, path)
    surface.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*WIRE_COLOR))
    surface.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(MATT)
    surface.CreateInput("opacityThreshold", Sdf.ValueTypeNames.Float).Set(CUT)
    place = primvar_reader(stage, path.AppendChild("place"), "float2", WITHIN_QUAD, Sdf.ValueTypeNames.Float2)
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
