"""Preview surfaces in the displayColor of the prim they are bound to."""

from __future__ import annotations

from typing import Any

from balloon_usd.openusd import Sdf, UsdGeom
from balloon_usd.stage.shaders import preview_surface, primvar_reader

AIR_ROUGHNESS = 0.4
PRINT_ROUGHNESS = 0.15
"""As shiny as latex."""
STRESS_ROUGHNESS = 0.6
"""Dull, so that no reflection is taken for a colour."""


def author_painted_material(stage: Any, path: Any, roughness: float) -> Any:
    """A plain surface in the prim's displayColor."""
    material, surface = preview_surface(stage, path)
    name = UsdGeom.Primvar.StripPrimvarsName(UsdGeom.Tokens.primvarsDisplayColor)
    color = primvar_reader(stage, path.AppendChild("color"), "float3", name, Sdf.ValueTypeNames.Float3)
    surface.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).ConnectToSource(color)
    surface.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(roughness)
    return material
