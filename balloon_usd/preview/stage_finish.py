"""How the surface of a USD mesh takes light, as its material says: metallic, see-through, shiny, or wire."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from pxr import UsdGeom, UsdShade

from balloon_usd.preview.stage_color import subset_faces
from balloon_usd.stage.looks import WITHIN_QUAD

if TYPE_CHECKING:
    import numpy.typing as npt

    Finishes = npt.NDArray[np.float32]

PREVIEW_SURFACE = "UsdPreviewSurface"
MIRROR, MATT = 0.3, 0.9
"""Roughness up to which a surface reflects as polished latex does, and from which on it does not at all."""
LATEX = (0.0, 1.0, 1.0)
"""Metallic, opacity and shine (0..1) of what has no material."""


@dataclass(frozen=True)
class _Inputs:
    """Constant inputs of a preview surface, and their fallbacks."""

    shader: Any

    def value(self, name: str, fallback: float) -> float:
        """Return a constant input; one that is connected counts as not authored."""
        found = self.shader.GetInput(name)
        value = found.Get() if found and not found.HasConnectedSource() else None
        return fallback if value is None else float(value)


def face_finishes(mesh: Any, faces: int) -> Finishes:
    """Return metallic, opacity and shine of every face (F, 3) of a `UsdGeom.Mesh`.

    A material bound to a face subset is stronger than the mesh's own.

    Raises:
        PreviewError: a subset has faces that are not there.
    """
    binding = UsdShade.MaterialBindingAPI(mesh.GetPrim())
    finishes = np.tile(np.asarray(_finish(binding) or LATEX, dtype=np.float32), (faces, 1))
    for subset in binding.GetMaterialBindSubsets():
        own = _finish(UsdShade.MaterialBindingAPI(subset.GetPrim()))
        if own is not None:
            finishes[subset_faces(subset, faces)] = own
    return finishes


def is_wire(mesh: Any) -> bool:
    """Tell whether a texture cuts away all of a mesh but the edges of its quads."""
    shader = _preview_surface(UsdShade.MaterialBindingAPI(mesh.GetPrim()))
    if shader is None or not UsdGeom.PrimvarsAPI(mesh).HasPrimvar(WITHIN_QUAD):
        return False
    opacity = shader.GetInput("opacity")
    cut = _Inputs(shader).value("opacityThreshold", 0.0) > 0.0
    return cut and bool(opacity and opacity.HasConnectedSource())


def _preview_surface(binding: Any) -> Any | None:
    material, _ = binding.ComputeBoundMaterial()
    shader = material.ComputeSurfaceSource()[0] if material else None
    return shader if shader and shader.GetIdAttr().Get() == PREVIEW_SURFACE else None


def _finish(binding: Any) -> tuple[float, float, float] | None:
    """Return metallic, opacity and shine of what is bound, if it is a preview surface."""
    shader = _preview_surface(binding)
    if shader is None:
        return None
    inputs = _Inputs(shader)
    rough = inputs.value("roughness", 0.5)
    shine = (MATT - rough) / (MATT - MIRROR)
    found = (inputs.value("metallic", 0.0), inputs.value("opacity", 1.0), shine)
    return tuple(min(max(value, 0.0), 1.0) for value in found)  # type: ignore[return-value]
