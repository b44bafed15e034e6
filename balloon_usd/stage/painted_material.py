"""Preview surfaces that read a primvar of the prim they are bound to, such as its displayColor."""

from __future__ import annotations

from typing import Any

from pxr import Sdf, UsdGeom, UsdShade

AIR_ROUGHNESS = 0.4
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


def preview_surface(stage: Any, path: Any) -> tuple[Any, Any]:
    """A material at a path and its surface shader, without inputs."""
    material = UsdShade.Material.Define(stage, path)
    surface = UsdShade.Shader.Define(stage, path.AppendChild("preview"))
    surface.CreateIdAttr("UsdPreviewSurface")
    out = surface.CreateOutput("surface", Sdf.ValueTypeNames.Token)
    material.CreateSurfaceOutput().ConnectToSource(out)
    return material, surface


def primvar_reader(stage: Any, path: Any, kind: str, name: str, type_name: Any) -> Any:
    """A shader that reads a primvar; returns its output."""
    reader = UsdShade.Shader.Define(stage, path)
    reader.CreateIdAttr(f"UsdPrimvarReader_{kind}")
    reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set(name)
    return reader.CreateOutput("result", type_name)
