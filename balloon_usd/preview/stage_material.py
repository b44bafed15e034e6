"""The preview surfaces that are bound to a mesh and to subsets of its faces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdShade
from balloon_usd.preview.error import PreviewError
from balloon_usd.stage.shaders import PREVIEW_SURFACE

if TYPE_CHECKING:
    import numpy.typing as npt


@dataclass(frozen=True)
class PreviewSurface:
    """The inputs of a preview surface."""

    shader: Any

    def constant(self, name: str) -> Any:
        """Return the value of an input, None where it is not authored or something is connected."""
        found = self.shader.GetInput(name)
        return found.Get() if found and not found.HasConnectedSource() else None

    def is_connected(self, name: str) -> bool:
        """Tell whether a texture or another shader gives an input its values."""
        found = self.shader.GetInput(name)
        return bool(found and found.HasConnectedSource())


def bound_surface(prim: Any) -> PreviewSurface | None:
    """Return the preview surface that is bound to a prim, None where there is none."""
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    shader = material.ComputeSurfaceSource()[0] if material else None
    return PreviewSurface(shader) if shader and shader.GetIdAttr().Get() == PREVIEW_SURFACE else None


def bound_subsets(mesh: Any) -> list[Any]:
    """Return the face subsets of a `UsdGeom.Mesh` that may have materials of their own."""
    return list(UsdShade.MaterialBindingAPI(mesh.GetPrim()).GetMaterialBindSubsets())


def subset_faces(subset: Any, count: int) -> npt.NDArray[np.int64]:
    """Return the faces of a subset.

    Raises:
        PreviewError: they are not among the `count` faces of the mesh.
    """
    faces = np.asarray(subset.GetIndicesAttr().Get() or [], dtype=np.int64)
    if len(faces) and (faces.min() < 0 or faces.max() >= count):
        raise PreviewError(f"{subset.GetPath()} names faces that its mesh has not")
    return faces
