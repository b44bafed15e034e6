"""The looks of a sculpture: what its rubber is drawn as, and whether the air in it shows.

The looks are variants of the root prim. What they decide is authored in them alone: an opinion of the
prim itself in the same layer stack would be stronger than theirs. A stage in one file has one look,
without variants, since it is for readers that do not compose.
"""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Gf, Sdf, UsdGeom, UsdShade, Vt
from balloon_usd.stage.error import StageError
from balloon_usd.stage.prim_paths import part_path, root_path
from balloon_usd.stage.variant_sets import LOOK

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.stage.description import MeshDescription, StageDescription

RECIPE = "recipe"
"""Shiny latex in the colours of the recipe."""
CLEAR = "clear"
"""The same colours, see-through: the walls behind show, and the air inside."""
CHROME = "chrome"
"""Metallic foil, tinted by the colours of the recipe."""
CLAY = "clay"
"""All in one matt grey, to judge the form."""
PRINT = "print"
"""Latex in the colours of the recipe, with a print that shows how it turns."""
STRESS = "stress"
"""Stretch as a colour, see `balloon_usd.stage.stretch_color`."""
THESIS = "thesis"
"""Orange wire, one a spring, and the air inside, as Kosaka 2008, chapter 4, shows it."""

ON_EVERY_STAGE = (RECIPE, CLEAR, CHROME, CLAY, PRINT, STRESS)
"""Looks that need nothing but rubber."""
SHOWS_AIR = frozenset({CLEAR, THESIS})
"""Looks in which one sees into the balloons."""

CLAY_COLOR = (0.45, 0.45, 0.45)
"""Linear rgb."""

WITHIN_QUAD = "quad_st"
"""Face-varying primvar that runs from 0 to 1 along both sides of each quad."""


def looks_of(description: StageDescription, *, textured: bool = True) -> tuple[str, ...]:
    """Looks that a stage can have, with textures or without."""
    return (*ON_EVERY_STAGE, THESIS) if description.airs and textured else ON_EVERY_STAGE


def default_look(description: StageDescription, *, textured: bool = True) -> str:
    """Look that a stage shows unless another one is asked for."""
    return THESIS if THESIS in looks_of(description, textured=textured) else RECIPE


def require_look(look: str, description: StageDescription, *, textured: bool = True) -> None:
    """Refuse a look that the stage cannot have.

    Raises:
        StageError: With the nearest look that it can have, or all of them.
    """
    known = looks_of(description, textured=textured)
    if look in known:
        return
    if look == THESIS:
        why = "it has no air" if textured else "a usdz holds no textures"
        raise StageError(f'"{description.name}" has no look "{look}" since {why}, take "{RECIPE}"')
    meant = get_close_matches(look.lower(), known, n=1)
    instead = f'did you mean "{meant[0]}"?' if meant else f"expected one of {', '.join(known)}"
    raise StageError(f'"{description.name}" has no look "{look}", {instead}')


def author_looks(
    stage: Any, description: StageDescription, materials: Mapping[str, Mapping[str, Any]]
) -> None:
    """Author every look as a variant of the root prim, and select the one that shows by itself.

    `materials`: material of each mesh by its name, by look.
    """
    looks = stage.GetPrimAtPath(root_path(description.name)).GetVariantSets().AddVariantSet(LOOK)
    for look in looks_of(description):
        looks.AddVariant(look)
        looks.SetVariantSelection(look)
        with looks.GetVariantEditContext():
            author_look(stage, description, look, materials[look])
    looks.SetVariantSelection(default_look(description))


def author_look(stage: Any, description: StageDescription, look: str, materials: Mapping[str, Any]) -> None:
    """Author what one look decides, at the stage's edit target.

    `materials`: material of each mesh by its name.
    """
    for mesh in description.meshes:
        prim = stage.OverridePrim(part_path(description.name, mesh.name))
        UsdShade.MaterialBindingAPI(prim).Bind(materials[mesh.name])
        UsdGeom.Gprim(prim).CreateDoubleSidedAttr(look in SHOWS_AIR)
        # Colours of faces or vertices come with the geometry or the samples.
        if look not in (PRINT, STRESS):
            _author_display_color(prim, mesh, look)
    for cloud in description.airs:
        prim = stage.OverridePrim(part_path(description.name, cloud.name))
        shown = UsdGeom.Tokens.inherited if look in SHOWS_AIR else UsdGeom.Tokens.invisible
        UsdGeom.Imageable(prim).CreateVisibilityAttr(shown)


def _author_display_color(prim: Any, mesh: MeshDescription, look: str) -> None:
    """One colour a mesh, for readers that know no materials."""
    primvar = UsdGeom.PrimvarsAPI(prim).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, UsdGeom.Tokens.constant
    )
    primvar.Set(Vt.Vec3fArray([Gf.Vec3f(*(CLAY_COLOR if look == CLAY else mesh.color))]))


def author_within_quad(prim: Any, quads: int) -> None:
    """Author the texture coordinates within each of a mesh's quads."""
    primvar = UsdGeom.PrimvarsAPI(prim).CreatePrimvar(
        WITHIN_QUAD, Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.faceVarying
    )
    primvar.Set(Vt.Vec2fArray([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]))
    primvar.SetIndices(Vt.IntArray.FromNumpy(np.tile(np.arange(4, dtype=np.int32), quads)))
