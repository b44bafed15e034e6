"""A print on the rubber: two rows of dashes along every balloon, which show how it turns."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Sdf, UsdGeom, Vt

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.stage.description import MeshDescription

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
    dashed: NDArray[np.bool_] = ((around * ROWS) % 1.0 < WIDE * ROWS) & (along % DASH < 0.5 * DASH)
    return dashed


def author_print(prim: Any, mesh: MeshDescription) -> None:
    """Author the colours of a mesh's quads, with their print."""
    colors = np.where(printed(mesh.st)[:, None], np.array(INK), np.array(mesh.color)).astype(np.float32)
    primvar = UsdGeom.PrimvarsAPI(prim).CreatePrimvar(
        "displayColor", Sdf.ValueTypeNames.Color3fArray, UsdGeom.Tokens.uniform
    )
    primvar.Set(Vt.Vec3fArray.FromNumpy(colors))
