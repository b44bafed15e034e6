"""All meshes of a stage as one: faces once, points and fields at any time code."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.mesh_file.error import MeshFileError
from balloon_usd.openusd import Sdf, UsdGeom
from balloon_usd.stage.animated import BUBBLES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.preview.read_stage import StageScene
    from balloon_usd.preview.stage_mesh import StageMesh

POINT_FIELDS = ("stretch", "pressure")
"""Vertex primvars that are passed on where any mesh has them; NaN on the others."""

CELL_TYPES = {3: "triangle", 4: "quad"}
"""What meshio calls faces with so many corners; with more they are a `polygon`."""


@dataclass(frozen=True)
class Cells:
    """All faces with one number of corners."""

    corners: NDArray[np.int32]
    """(F, k) points of all meshes together, counter-clockwise seen from outside."""
    balloon: NDArray[np.int32]
    """(F,) number of the mesh."""
    bubble: NDArray[np.int32]
    """(F,) the stage's number of the bubble, -1 where it has none."""

    @property
    def kind(self) -> str:
        """What meshio calls these faces."""
        return CELL_TYPES.get(self.corners.shape[1], "polygon")


@dataclass(frozen=True)
class MergedMesh:
    """The balloons of a stage, their points one after another."""

    scene: StageScene
    balloons: tuple[str, ...]
    """Name of each mesh."""
    bubbles: tuple[str, ...]
    """Names that `Cells.bubble` counts in; empty if the stage does not say."""
    cells: tuple[Cells, ...]
    counts: tuple[int, ...]
    """Number of points of each mesh."""

    def points(self, time_code: float) -> NDArray[np.float32]:
        """Return the points (V, 3) of all meshes at a time code (m, z up).

        Raises:
            MeshFileError: a mesh has another number of points than in the first frame.
        """
        parts = self.scene.points(time_code)
        for mesh, part, count in zip(self.scene.meshes, parts, self.counts, strict=True):
            if len(part) != count:
                raise MeshFileError(
                    f"{mesh.path} has {len(part)} points at time code {time_code:g}, not {count}"
                )
        return np.concatenate(parts)

    def fields(self, time_code: float) -> dict[str, NDArray[np.float32]]:
        """Return the values (V,) that vertices have at a time code, by name."""
        found = {name: self._field(name, time_code) for name in POINT_FIELDS}
        return {name: field for name, field in found.items() if field is not None}

    def _field(self, name: str, time_code: float) -> NDArray[np.float32] | None:
        parts = [_vertex_floats(mesh.prim, name, time_code) for mesh in self.scene.meshes]
        if all(part is None for part in parts):
            return None
        filled = [_fitting(part, count) for part, count in zip(parts, self.counts, strict=True)]
        return np.concatenate(filled)

    @cached_property
    def has_bubbles(self) -> bool:
        """Whether any face has a bubble."""
        return any(cells.bubble.max() >= 0 for cells in self.cells)

    def seconds(self, time_code: float) -> float:
        """Return the time since the stage's first frame."""
        return (time_code - self.scene.start) / self.scene.fps


def merged_mesh(scene: StageScene) -> MergedMesh:
    """Join the meshes of a stage.

    Raises:
        MeshFileError: faces change in time, or points are missing.
    """
    for mesh in scene.meshes:
        _require_still_faces(mesh)
    counts = tuple(len(points) for points in scene.points(scene.start))
    sizes = np.unique(np.concatenate([mesh.face_counts for mesh in scene.meshes]))
    root = scene.stage.GetDefaultPrim()
    names = root.GetAttribute(BUBBLES).Get() if root else None
    cells = tuple(_cells_of(scene.meshes, counts, size) for size in sizes)
    balloons = _different([Sdf.Path(mesh.path).name for mesh in scene.meshes])
    return MergedMesh(scene, balloons, tuple(map(str, names or ())), cells, counts)


def _cells_of(meshes: Sequence[StageMesh], counts: Sequence[int], size: int) -> Cells:
    """Gather the faces with `size` corners of meshes with `counts` points."""
    corners, balloon, bubble = [], [], []
    for number, mesh in enumerate(meshes):
        faces = np.flatnonzero(mesh.face_counts == size)
        starts = (np.cumsum(mesh.face_counts) - mesh.face_counts)[faces]
        corners.append(mesh.corners[starts[:, None] + np.arange(size)] + sum(counts[:number]))
        balloon.append(np.full(len(faces), number, np.int32))
        bubble.append(_face_integers(mesh, "bubble")[faces])
    joined = np.concatenate(corners).astype(np.int32)
    return Cells(joined, np.concatenate(balloon), np.concatenate(bubble))


def _require_still_faces(mesh: StageMesh) -> None:
    schema = UsdGeom.Mesh(mesh.prim)
    for attribute in (schema.GetFaceVertexCountsAttr(), schema.GetFaceVertexIndicesAttr()):
        if attribute.ValueMightBeTimeVarying():
            raise MeshFileError(f"{mesh.path} changes its faces in time, which is not exported")


def _face_integers(mesh: StageMesh, name: str) -> NDArray[np.int32]:
    """Return a primvar with an integer for each face (F,), -1 where there is none."""
    primvar = UsdGeom.PrimvarsAPI(mesh.prim).GetPrimvar(name)
    values = np.asarray(primvar.ComputeFlattened()) if primvar.HasValue() else np.zeros(0)
    if values.shape != mesh.face_counts.shape or values.dtype.kind not in "iu":
        return np.full(len(mesh.face_counts), -1, np.int32)
    return values.astype(np.int32)


def _vertex_floats(prim: Any, name: str, time_code: float) -> NDArray[np.float32] | None:
    """Return a primvar with a float for each vertex at a time code, None if there is none."""
    primvar = UsdGeom.PrimvarsAPI(prim).GetPrimvar(name)
    if not primvar.HasValue() or primvar.GetInterpolation() != UsdGeom.Tokens.vertex:
        return None
    values = np.asarray(primvar.ComputeFlattened(time_code))
    return values if values.ndim == 1 and values.dtype == np.float32 else None


def _fitting(values: NDArray[np.float32] | None, count: int) -> NDArray[np.float32]:
    if values is None or len(values) != count:
        return np.full(count, np.nan, np.float32)
    return values


def _different(names: Sequence[str]) -> tuple[str, ...]:
    """Number the names that are used more than once."""
    seen: dict[str, int] = {}
    different = []
    for name in names:
        seen[name] = seen.get(name, 0) + 1
        different.append(name if names.count(name) == 1 else f"{name}_{seen[name]}")
    return tuple(different)
