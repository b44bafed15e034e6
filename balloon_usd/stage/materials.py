"""Latex, one material a colour, bound to every mesh of that colour; wire and air where there is air."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pxr import Gf, Sdf, UsdGeom, UsdShade

from balloon_usd.stage.looks import author_looks
from balloon_usd.stage.prim_paths import materials_path, part_path
from balloon_usd.stage.thesis_materials import AIR, WIRE, author_air_material, author_wire_material

if TYPE_CHECKING:
    from balloon_usd.stage.description import MeshDescription, StageDescription

Color = tuple[float, float, float]

# Looks, not measurements: a blown-up balloon is a smooth, slightly cloudy film.
REFRACTION = 1.52
"""Index of refraction of natural rubber [1]."""
ROUGHNESS = 0.18
COAT = 0.5
COAT_ROUGHNESS = 0.05
SUBSURFACE = 0.35


def author_materials(stage: Any, description: StageDescription) -> None:
    """Author the materials and bind them; meshes that are not in the stage become overs."""
    names = materials_by_color(description.meshes, (AIR, WIRE) if description.airs else ())
    scope = materials_path(description.name)
    stage.OverridePrim(scope.GetParentPath())
    UsdGeom.Scope.Define(stage, scope)
    materials = {color: _author_latex(stage, scope.AppendChild(name), color) for color, name in names.items()}
    for mesh in description.meshes:
        prim = stage.OverridePrim(part_path(description.name, mesh.name))
        binding = UsdShade.MaterialBindingAPI.Apply(prim)
        if not description.airs:
            binding.Bind(materials[mesh.color])
    if description.airs:
        particles = author_air_material(stage, scope.AppendChild(AIR))
        for air in description.airs:
            prim = stage.OverridePrim(part_path(description.name, air.name))
            UsdShade.MaterialBindingAPI.Apply(prim).Bind(particles)
        wire = author_wire_material(stage, scope.AppendChild(WIRE))
        latex = {mesh.name: materials[mesh.color] for mesh in description.meshes}
        author_looks(stage, description, latex, wire)


def materials_by_color(meshes: tuple[MeshDescription, ...], taken: tuple[str, ...] = ()) -> dict[Color, str]:
    """Material name of each colour: the first mesh of a colour names it, a taken name is numbered."""
    names: dict[Color, str] = {}
    for mesh in meshes:
        name, number = mesh.material, 2
        while mesh.color not in names and name in (*names.values(), *taken):
            name, number = f"{mesh.material}_{number}", number + 1
        names.setdefault(mesh.color, name)
    return names


def _author_latex(stage: Any, path: Any, color: Color) -> Any:
    """A preview surface that every reader knows, and OpenPBR beside it for those that know more."""
    material = UsdShade.Material.Define(stage, path)
    preview = _shader(stage, path.AppendChild("preview"), "UsdPreviewSurface", "diffuseColor", color)
    _floats(preview, ior=REFRACTION, roughness=ROUGHNESS, clearcoat=COAT, clearcoatRoughness=COAT_ROUGHNESS)
    surface = preview.CreateOutput("surface", Sdf.ValueTypeNames.Token)
    material.CreateSurfaceOutput().ConnectToSource(surface)

    open_pbr = "ND_open_pbr_surface_surfaceshader"
    shader = _shader(stage, path.AppendChild("openpbr"), open_pbr, "base_color", color)
    _floats(shader, specular_ior=REFRACTION, specular_roughness=ROUGHNESS, subsurface_weight=SUBSURFACE)
    _floats(shader, coat_weight=COAT, coat_roughness=COAT_ROUGHNESS)
    out = shader.CreateOutput("out", Sdf.ValueTypeNames.Token)
    material.CreateSurfaceOutput("mtlx").ConnectToSource(out)
    return material


def _shader(stage: Any, path: Any, identifier: str, color_input: str, color: Color) -> Any:
    shader = UsdShade.Shader.Define(stage, path)
    shader.CreateIdAttr(identifier)
    shader.CreateInput(color_input, Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*color))
    return shader


def _floats(shader: Any, **inputs: float) -> None:
    for name, value in inputs.items():
        shader.CreateInput(name, Sdf.ValueTypeNames.Float).Set(value)
