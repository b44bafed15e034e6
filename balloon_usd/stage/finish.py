"""What the rubber is made of in each look, as a preview surface and as OpenPBR."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Gf, Sdf, UsdShade
from balloon_usd.stage.looks import CHROME, CLAY, CLEAR, RECIPE
from balloon_usd.stage.shaders import preview_surface

if TYPE_CHECKING:
    from collections.abc import Mapping

Color = tuple[float, float, float]

# Looks, not measurements: a blown-up balloon is a smooth, slightly cloudy film.
REFRACTION = 1.52
"""Index of refraction of natural rubber [1]."""
COAT_ROUGHNESS = 0.05
SUBSURFACE_RADIUS = 1.0e-3
"""How far light goes in cloudy latex [m]; where nothing is said OpenPBR takes a metre."""
CLEAR_OPACITY = 0.35
"""What one wall of clear latex hides of what is behind it [1]."""


@dataclass(frozen=True)
class Finish:
    """Inputs of both shaders besides the colour."""

    preview: Mapping[str, float]
    """Inputs of UsdPreviewSurface."""
    open_pbr: Mapping[str, float]
    """Inputs of OpenPBR."""
    flags: Mapping[str, bool] = field(default_factory=dict)
    """Inputs of OpenPBR that are yes or no."""


FINISHES = {
    RECIPE: Finish(
        {"ior": REFRACTION, "roughness": 0.18, "clearcoat": 0.5, "clearcoatRoughness": COAT_ROUGHNESS},
        {
            "specular_ior": REFRACTION,
            "specular_roughness": 0.18,
            "subsurface_weight": 0.35,
            "subsurface_radius": SUBSURFACE_RADIUS,
            "coat_weight": 0.5,
            "coat_roughness": COAT_ROUGHNESS,
        },
    ),
    CLEAR: Finish(
        {"ior": REFRACTION, "roughness": 0.08, "opacity": CLEAR_OPACITY},
        {"specular_ior": REFRACTION, "specular_roughness": 0.08, "geometry_opacity": CLEAR_OPACITY},
        {"geometry_thin_walled": True},
    ),
    CHROME: Finish(
        {"metallic": 1.0, "roughness": 0.08},
        {"base_metalness": 1.0, "specular_roughness": 0.08},
    ),
    CLAY: Finish(
        {"roughness": 1.0},
        {"base_diffuse_roughness": 1.0, "specular_weight": 0.0},
    ),
}


def author_material(stage: Any, path: Any, color: Color, finish: Finish) -> Any:
    """A preview surface that every reader knows, and OpenPBR beside it for those that know more."""
    material, preview = preview_surface(stage, path)
    preview.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*color))
    _inputs(preview, finish.preview, Sdf.ValueTypeNames.Float)

    open_pbr = UsdShade.Shader.Define(stage, path.AppendChild("openpbr"))
    open_pbr.CreateIdAttr("ND_open_pbr_surface_surfaceshader")
    colored = (
        ("base_color", "subsurface_color") if "subsurface_weight" in finish.open_pbr else ("base_color",)
    )
    for name in colored:
        open_pbr.CreateInput(name, Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*color))
    _inputs(open_pbr, finish.open_pbr, Sdf.ValueTypeNames.Float)
    _inputs(open_pbr, finish.flags, Sdf.ValueTypeNames.Bool)
    out = open_pbr.CreateOutput("out", Sdf.ValueTypeNames.Token)
    material.CreateSurfaceOutput("mtlx").ConnectToSource(out)
    return material


def _inputs(shader: Any, inputs: Mapping[str, float | bool], kind: Any) -> None:
    for name, value in inputs.items():
        shader.CreateInput(name, kind).Set(value)
