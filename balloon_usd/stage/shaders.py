"""The shaders that materials are made of: the preview surface that every reader knows, and what it reads."""

from __future__ import annotations

from typing import Any

from balloon_usd.openusd import Sdf, UsdShade

PREVIEW_SURFACE = "UsdPreviewSurface"


def preview_surface(stage: Any, path: Any) -> tuple[Any, Any]:
    """A material at a path and its surface shader, without inputs."""
    material = UsdShade.Material.Define(stage, path)
    surface = UsdShade.Shader.Define(stage, path.AppendChild("preview"))
    surface.CreateIdAttr(PREVIEW_SURFACE)
    out = surface.CreateOutput("surface", Sdf.ValueTypeNames.Token)
    material.CreateSurfaceOutput().ConnectToSource(out)
    return material, surface


def primvar_reader(stage: Any, path: Any, kind: str, name: str, type_name: Any) -> Any:
    """A shader that reads a primvar; returns its output."""
    reader = UsdShade.Shader.Define(stage, path)
    reader.CreateIdAttr(f"UsdPrimvarReader_{kind}")
    reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set(name)
    return reader.CreateOutput("result", type_name)
