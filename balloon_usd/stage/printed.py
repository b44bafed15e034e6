"""A print on the rubber: two rows of dashes along every balloon, which show how it turns."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Sdf, UsdGeom, Vt
from balloon_usd.stage.looks import PRINT
from balloon_usd.stage.prim_paths import part_path, root_path
from balloon_usd.stage.variant_sets import LOOK

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.stage.description import MeshDescription, StageDescription

INK = (0.9, 0.9, 0.9)
"""Colour of the print, linear rgb: white ink that lets a little of the rubber through."""
ROWS = 2
"""Rows of dashes round a balloon."""
WIDE = 1.0 / 12.0
"""Width of a row as a share of the way round: a quad of the coarsest mesh."""
DASH = 0.08
"""Length of a dash and of the gap behind it, in texture coordinates along the balloon."""


def printed(st: NDArray[np.float32]) -> NDArray[np.bool_]:
    """Return which quads are printed on, (Q,); `st`: texture coordinates of their corners, (Q, 4, 2)."""
    around, along = st.mean(axis=1).T
    in_row: NDArray[np.bool_] = (around * ROWS) % 1.0 < WIDE * ROWS
    # Caps lie in tiles of their own.
    printed_on: NDArray[np.bool_] = in_row & (around < 1.0) & (along % DASH < 0.5 * DASH)
    return printed_on


def author_print(stage: Any, description: StageDescription) -> None:
    """Author the colours of all quads, with their print, at the stage's edit target."""
    for mesh in description.meshes:
        _author_colors(stage.OverridePrim(part_path(description.name, mesh.name)), mesh)


def author_print_variant(stage: Any, description: StageDescription) -> None:
    """Author these colours in the look that shows them, and in no other: their number is that of the mesh."""
    looks = stage.GetPrimAtPath(root_path(description.name)).GetVariantSets().AddVariantSet(LOOK)
    looks.AddVariant(PRINT)
    looks.SetVariantSelection(PRINT)
    with looks.GetVariantEditContext():
        author_print(stage, description)
    looks.ClearVariantSelection()


def _author_colors(prim: Any, mesh: MeshDescription) -> None:
    colors = np.where(printed(mesh.st)[:, None], np.array(INK), np.array(mesh.color)).astype(np.float32)
    primvar = UsdGeom.PrimvarsAPI(prim).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, UsdGeom.Tokens.uniform
    )
    primvar.Set(Vt.Vec3fArray.FromNumpy(colors))
