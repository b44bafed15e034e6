"""The plain colour of each face of a USD mesh, as its material or its displayColor gives it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom
from balloon_usd.preview.error import PreviewError
from balloon_usd.preview.stage_material import bound_subsets, bound_surface, subset_faces

if TYPE_CHECKING:
    import numpy.typing as npt

    Colors = npt.NDArray[np.float32]

UNPAINTED = (0.55, 0.53, 0.50)
"""Linear rgb of a mesh without any colour: undyed latex."""


def face_colors(mesh: Any, face_counts: npt.NDArray[np.int64], corners: npt.NDArray[np.int64]) -> Colors:
    """Return the linear rgb of every face (F, 3) of a `UsdGeom.Mesh` at its default time.

    A material bound to a face subset is stronger than the mesh's own, which is stronger than displayColor.

    Raises:
        PreviewError: there are colours for another number of faces, or a subset of faces that are not there.
    """
    color = _material_color(mesh)
    colors = _display_colors(mesh, face_counts, corners) if color is None else _all(color, len(face_counts))
    for subset in bound_subsets(mesh):
        color = _material_color(subset)
        if color is not None:
            colors[subset_faces(subset, len(face_counts))] = color
    return colors


def vertex_colors(mesh: Any, time_code: float) -> Colors | None:
    """Return the linear rgb of every vertex (V, 3) at a time code; None where the faces have colours.

    They do where displayColor has a value for each vertex, and no material has a colour of its own.
    """
    primvar = mesh.GetDisplayColorPrimvar()
    by_vertex = primvar.GetInterpolation() in {UsdGeom.Tokens.vertex, UsdGeom.Tokens.varying}
    if not by_vertex or any(_material_color(bound) is not None for bound in (mesh, *bound_subsets(mesh))):
        return None
    values = np.asarray(primvar.ComputeFlattened(time_code) or [], dtype=np.float32).reshape(-1, 3)
    points = mesh.GetPointsAttr().Get(time_code)
    return values if len(values) == len(points or []) else None


def _material_color(bound: Any) -> tuple[float, float, float] | None:
    """Return the constant diffuse colour of the preview surface of a mesh or subset, if there is one."""
    surface = bound_surface(bound.GetPrim())
    value = surface.constant("diffuseColor") if surface else None
    return None if value is None else (value[0], value[1], value[2])


def _display_colors(mesh: Any, face_counts: npt.NDArray[np.int64], corners: npt.NDArray[np.int64]) -> Colors:
    primvar = mesh.GetDisplayColorPrimvar()
    values = np.asarray(primvar.ComputeFlattened() or [UNPAINTED], dtype=np.float32).reshape(-1, 3)
    faces = len(face_counts)
    interpolation = primvar.GetInterpolation()
    if len(values) == 1:
        return _all(values[0], faces)
    if interpolation == UsdGeom.Tokens.uniform:
        expected = faces
    elif interpolation == UsdGeom.Tokens.faceVarying:
        expected = len(corners)
    else:
        expected = int(corners.max(initial=-1)) + 1
    if len(values) < expected:
        raise PreviewError(f"{mesh.GetPath()} has {len(values)} colours, but needs {expected}")
    if interpolation == UsdGeom.Tokens.uniform:
        return values[:faces].copy()
    by_corner = values[: len(corners)] if interpolation == UsdGeom.Tokens.faceVarying else values[corners]
    starts = np.cumsum(face_counts) - face_counts
    return np.asarray(np.add.reduceat(by_corner, starts, axis=0) / face_counts[:, None], dtype=np.float32)


def _all(color: npt.ArrayLike, faces: int) -> Colors:
    return np.tile(np.asarray(color, dtype=np.float32), (faces, 1))
