"""Two looks of a sculpture with air: as latex, or as Kosaka 2008, chapter 4, shows it.

The looks are variants of the root prim. What they decide is authored in them alone: an opinion of the
prim itself in the same layer stack would be stronger than theirs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from pxr import Sdf, UsdGeom, UsdShade, Vt

from balloon_usd.stage.prim_paths import part_path, root_path

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.stage.description import StageDescription

VARIANT_SET = "look"
"""Variant set of the root prim of a stage with air: what the rubber is drawn as."""
LATEX = "latex"
"""Opaque rubber: the air in it cannot be seen."""
THESIS = "thesis"
"""Orange wire, one a spring, and the air inside."""

WITHIN_QUAD = "quad_st"
"""Face-varying primvar that runs from 0 to 1 along both sides of each quad."""


def author_looks(stage: Any, description: StageDescription, latex: Mapping[str, Any], wire: Any) -> None:
    """Author both looks as variants of the root prim, and select the thesis's.

    Args:
        stage: takes the variants.
        description: what the stage shows.
        latex: material of each mesh in the look of latex, by the mesh's name.
        wire: material of all meshes in the thesis's look.
    """
    looks = stage.GetPrimAtPath(root_path(description.name)).GetVariantSets().AddVariantSet(VARIANT_SET)
    for look in (LATEX, THESIS):
        looks.AddVariant(look)
        looks.SetVariantSelection(look)
        with looks.GetVariantEditContext():
            for mesh in description.meshes:
                prim = stage.OverridePrim(part_path(description.name, mesh.name))
                bound = wire if look == THESIS else latex[mesh.name]
                UsdShade.MaterialBindingAPI(prim).Bind(bound)
            for cloud in description.airs:
                prim = stage.OverridePrim(part_path(description.name, cloud.name))
                shown = UsdGeom.Tokens.inherited if look == THESIS else UsdGeom.Tokens.invisible
                UsdGeom.Imageable(prim).CreateVisibilityAttr(shown)
    looks.SetVariantSelection(THESIS)


def author_within_quad(prim: Any, quads: int) -> None:
    """Author the texture coordinates within each of a mesh's quads."""
    primvar = UsdGeom.PrimvarsAPI(prim).CreatePrimvar(
        WITHIN_QUAD, Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.faceVarying
    )
    primvar.Set(Vt.Vec2fArray([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]))
    primvar.SetIndices(Vt.IntArray.FromNumpy(np.tile(np.arange(4, dtype=np.int32), quads)))
