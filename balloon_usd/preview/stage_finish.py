"""How the surface of a USD mesh takes light, as its material says: metallic, see-through, shiny, or wire."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom
from balloon_usd.preview.stage_material import bound_subsets, bound_surface, subset_faces
from balloon_usd.stage.looks import WITHIN_QUAD

if TYPE_CHECKING:
    import numpy.typing as npt

    from balloon_usd.preview.stage_material import PreviewSurface

    Finishes = npt.NDArray[np.float32]

MIRROR, MATT = 0.3, 0.9
"""Roughness up to which a surface reflects as polished latex does, and from which on it does not at all."""
LATEX = (0.0, 1.0, 1.0)
"""Metallic, opacity and shine (0..1) of what has no material."""


def face_finishes(mesh: Any, faces: int) -> Finishes:
    """Return metallic, opacity and shine of every face (F, 3) of a `UsdGeom.Mesh`.

    A material bound to a face subset is stronger than the mesh's own.

    Raises:
        PreviewError: a subset has faces that are not there.
    """
    finishes = np.tile(np.asarray(_finish(mesh) or LATEX, dtype=np.float32), (faces, 1))
    for subset in bound_subsets(mesh):
        own = _finish(subset)
        if own is not None:
            finishes[subset_faces(subset, faces)] = own
    return finishes


def is_wire(mesh: Any) -> bool:
    """Tell whether a texture cuts away all of a mesh but the edges of its quads."""
    surface = bound_surface(mesh.GetPrim())
    if surface is None or not UsdGeom.PrimvarsAPI(mesh).HasPrimvar(WITHIN_QUAD):
        return False
    return _number(surface, "opacityThreshold", 0.0) > 0.0 and surface.is_connected("opacity")


def _finish(bound: Any) -> tuple[float, float, float] | None:
    """Return metallic, opacity and shine of the preview surface of a mesh or subset, if there is one."""
    surface = bound_surface(bound.GetPrim())
    if surface is None:
        return None
    shine = (MATT - _number(surface, "roughness", 0.5)) / (MATT - MIRROR)
    found = (_number(surface, "metallic", 0.0), _number(surface, "opacity", 1.0), shine)
    return tuple(min(max(value, 0.0), 1.0) for value in found)  # type: ignore[return-value]


def _number(surface: PreviewSurface, name: str, fallback: float) -> float:
    value = surface.constant(name)
    return fallback if value is None else float(value)
