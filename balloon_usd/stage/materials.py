"""The materials of all looks: one a colour and finish, and those that all balloons share."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import UsdGeom, UsdShade
from balloon_usd.stage.finish import FINISHES, Color, author_material
from balloon_usd.stage.looks import (
    CHROME,
    CLAY,
    CLAY_COLOR,
    CLEAR,
    PRINT,
    RECIPE,
    STRESS,
    THESIS,
    author_look,
    author_looks,
)
from balloon_usd.stage.painted_material import (
    AIR_ROUGHNESS,
    PRINT_ROUGHNESS,
    STRESS_ROUGHNESS,
    author_painted_material,
)
from balloon_usd.stage.prim_paths import materials_path, part_path
from balloon_usd.stage.thesis_materials import author_wire_material

if TYPE_CHECKING:
    from collections.abc import Iterable

    from balloon_usd.stage.description import StageDescription

AIR, WIRE = "air", "wire"
"""Materials of a stage with air; others that all balloons share are called as their look."""

COLORED = (RECIPE, CLEAR, CHROME)
"""Looks in the colours of the recipe."""
LOOK_OF_FINISH = {"latex": RECIPE, "clear": CLEAR, "chrome": CHROME}
"""Look that shows all balloons as those of a finish are in the colours of the recipe."""
LATEX = "latex"
"""What names of materials in the colours of the recipe begin with, and those of other finishes do not."""


def author_materials(
    stage: Any, description: StageDescription, looks: tuple[str, ...], shown: str | None = None
) -> None:
    """Author the materials of some looks and bind them; meshes that are not in the stage become overs.

    `shown`: the one look that the stage gets; None gives it all of them, as variants.
    """
    scope = materials_path(description.name)
    stage.OverridePrim(scope.GetParentPath())
    UsdGeom.Scope.Define(stage, scope)
    for mesh in description.meshes:
        prim = stage.OverridePrim(part_path(description.name, mesh.name))
        UsdShade.MaterialBindingAPI.Apply(prim)
    materials = {look: _materials_of(stage, description, look) for look in looks}
    if description.airs:
        particles = author_painted_material(stage, scope.AppendChild(AIR), AIR_ROUGHNESS)
        for air in description.airs:
            prim = stage.OverridePrim(part_path(description.name, air.name))
            UsdShade.MaterialBindingAPI.Apply(prim).Bind(particles)
    if shown is None:
        author_looks(stage, description, materials)
    else:
        author_look(stage, description, shown, materials[shown])


def _materials_of(stage: Any, description: StageDescription, look: str) -> dict[str, Any]:
    """Author the materials of one look; returns that of each mesh by its name."""
    scope = materials_path(description.name)
    if look in COLORED:
        names, made = material_names(description), {}
        for mesh in description.meshes:
            finish = LOOK_OF_FINISH[mesh.finish] if look == RECIPE else look
            path = scope.AppendChild(names[finish][mesh.color])
            made[mesh.name] = author_material(stage, path, mesh.color, FINISHES[finish])
        return made
    if look == THESIS:
        shared = author_wire_material(stage, scope.AppendChild(WIRE))
    elif look == PRINT:
        shared = author_painted_material(stage, scope.AppendChild(PRINT), PRINT_ROUGHNESS)
    elif look == STRESS:
        shared = author_painted_material(stage, scope.AppendChild(STRESS), STRESS_ROUGHNESS)
    else:
        shared = author_material(stage, scope.AppendChild(look), CLAY_COLOR, FINISHES[look])
    return dict.fromkeys((mesh.name for mesh in description.meshes), shared)


def material_names(description: StageDescription) -> dict[str, dict[Color, str]]:
    """Name of the material of each colour, by finish: latex_red, clear_red, chrome_red.

    The first mesh of a colour names it; a name that is taken is numbered.
    """
    taken = {CLAY, PRINT, STRESS, *((AIR, WIRE) if description.airs else ())}
    found: dict[str, dict[Color, str]] = {}
    for look in COLORED:
        names: dict[Color, str] = {}
        for mesh in description.meshes:
            if mesh.color not in names:
                wanted = mesh.material if look == RECIPE else f"{look}_{_paint(mesh.material)}"
                names[mesh.color] = _free(wanted, taken)
                taken.add(names[mesh.color])
        found[look] = names
    return found


def _paint(material: str) -> str:
    """What of a material's name says its colour: all but the word latex at its start."""
    return material.removeprefix(f"{LATEX}_")


def _free(name: str, taken: Iterable[str]) -> str:
    """The name, or if it is taken the name with the first number that is not."""
    free, number = name, 2
    while free in taken:
        free, number = f"{name}_{number}", number + 1
    return free
