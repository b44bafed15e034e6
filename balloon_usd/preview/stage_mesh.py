"""One mesh of a USD stage: its faces and colours once, its points at any time code."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Usd, UsdGeom
from balloon_usd.preview.error import PreviewError
from balloon_usd.preview.stage_color import face_colors, vertex_colors
from balloon_usd.preview.stage_finish import face_finishes, is_wire

if TYPE_CHECKING:
    import numpy.typing as npt

    from balloon_usd.preview.stage_place import World
    from balloon_usd.preview.subdivide import Numbers, Points


@dataclass(frozen=True)
class StageMesh:
    """One mesh of a stage; its topology does not move."""

    path: str
    face_counts: npt.NDArray[np.int64]
    """(F,) corners of each face."""
    corners: npt.NDArray[np.int64]
    """(C,) vertex of each corner, counter-clockwise seen from outside."""
    colors: npt.NDArray[np.float32]
    """(F, 3) linear rgb."""
    finishes: npt.NDArray[np.float32]
    """(F, 3) metallic, opacity and shine, 0..1."""
    wire: bool
    """Whether only the edges of its faces show."""
    prim: Any

    def points_at(self, time_code: float, world: World) -> Points:
        """Return the points (V, 3) at the time code of a world (m, z up).

        Raises:
            PreviewError: the faces name points that are not there.
        """
        points = np.asarray(UsdGeom.Mesh(self.prim).GetPointsAttr().Get(time_code))
        if points.dtype.kind != "f" or points.ndim != 2 or len(points) <= self.corners.max():
            raise PreviewError(f"{self.path} has too few points at time code {time_code:g}")
        return world.place(self.prim, points.astype(np.float64))

    def vertex_colors_at(self, time_code: float) -> npt.NDArray[np.float32] | None:
        """Return the linear rgb of every vertex (V, 3) at a time code; None where `colors` say it all."""
        return vertex_colors(UsdGeom.Mesh(self.prim), time_code)


def read_mesh(prim: Any) -> StageMesh:
    """Read a mesh prim; one without faces has no corners.

    Raises:
        PreviewError: its faces or colours are not right.
    """
    mesh, path = UsdGeom.Mesh(prim), str(prim.GetPath())
    first = Usd.TimeCode.EarliestTime()
    counts = np.asarray(mesh.GetFaceVertexCountsAttr().Get(first) or [], dtype=np.int64)
    corners = np.asarray(mesh.GetFaceVertexIndicesAttr().Get(first) or [], dtype=np.int64)
    _require_polygons(path, counts, corners)
    colors = face_colors(mesh, counts, corners)
    if mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded:
        corners = _reversed_faces(counts, corners)
    finishes = face_finishes(mesh, len(counts))
    return StageMesh(path, counts, corners, colors, finishes, is_wire(mesh), prim)


def _require_polygons(path: str, counts: Numbers, corners: Numbers) -> None:
    """Refuse faces that are no polygons; repeated corners may leave a triangle, but not less."""
    if len(counts) and counts.min() < 3:
        raise PreviewError(f"{path} has a face with {counts.min()} corners")
    if counts.sum() != len(corners):
        raise PreviewError(f"{path} has {len(corners)} corners but its faces need {counts.sum()}")
    if len(corners) and corners.min() < 0:
        raise PreviewError(f"{path} has a face with vertex {corners.min()}")
    face = np.repeat(np.arange(len(counts)), counts)
    keys = np.unique(face * (corners.max(initial=0) + 1) + corners)
    different = keys // (corners.max(initial=0) + 1)
    thin = np.flatnonzero(np.bincount(different, minlength=len(counts)) < 3)
    if len(thin):
        raise PreviewError(f"{path} has a face with fewer than 3 different corners, number {thin[0]}")


def _reversed_faces(counts: Numbers, corners: Numbers) -> Numbers:
    first = np.repeat(np.cumsum(counts) - counts, counts)
    last = first + np.repeat(counts, counts) - 1
    return np.asarray(corners[first + last - np.arange(len(corners))])
