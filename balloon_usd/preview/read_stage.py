"""Meshes, colours and moving points of any USD stage."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pxr import Tf, Usd, UsdGeom

from balloon_usd.preview.error import PreviewError
from balloon_usd.preview.stage_color import face_colors
from balloon_usd.stage.animated import STEP

if TYPE_CHECKING:
    import numpy.typing as npt

    from balloon_usd.preview.subdivide import Points

Y_UP_TO_Z_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""Turns row vectors of a stage whose y points up."""


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
    prim: Any

    def points_at(self, time_code: float, to_world: Any) -> Points:
        """Return the points (V, 3) of one time code, moved by a `UsdGeom.XformCache` of the same time."""
        points = np.asarray(UsdGeom.Mesh(self.prim).GetPointsAttr().Get(time_code), dtype=np.float64)
        if points.ndim != 2 or len(points) <= self.corners.max():
            raise PreviewError(f"{self.path} has too few points at time code {time_code:g}")
        matrix = np.asarray(to_world.GetLocalToWorldTransform(self.prim))
        return np.asarray(points @ matrix[:3, :3] + matrix[3, :3], dtype=np.float32)


@dataclass(frozen=True)
class StageScene:
    """What the preview draws of a stage."""

    title: str
    start: float
    """First time code."""
    end: float
    """Last time code."""
    fps: float
    meshes: tuple[StageMesh, ...]
    stage: Any

    def points(self, time_code: float) -> list[Points]:
        """Return the points (V, 3) of every mesh at a time code (m, z up).

        Raises:
            PreviewError: a mesh lacks points that its faces name.
        """
        to_world = UsdGeom.XformCache(time_code)
        scale = UsdGeom.GetStageMetersPerUnit(self.stage)
        turn = np.eye(3) if UsdGeom.GetStageUpAxis(self.stage) == UsdGeom.Tokens.z else Y_UP_TO_Z_UP
        moved = [mesh.points_at(time_code, to_world) for mesh in self.meshes]
        return [np.asarray(scale * points @ turn, dtype=np.float32) for points in moved]

    def doing(self, time_code: float) -> str:
        """Return what the hands do at a time code, "" if the stage does not say."""
        root = self.stage.GetDefaultPrim()
        said = root.GetAttribute(STEP).Get(time_code) if root and root.HasAttribute(STEP) else None
        return str(said or "")


def read_stage(path: str | Path) -> StageScene:
    """Open a stage and find its meshes.

    Raises:
        PreviewError: the file is not there, is no USD file, or shows no mesh.
    """
    if not Path(path).is_file():
        raise PreviewError(f"{path} is not a file")
    try:
        stage = Usd.Stage.Open(str(path))
    except Tf.ErrorException as error:
        raise PreviewError(f"{path} is not a USD file") from error
    visible = [_stage_mesh(prim) for prim in stage.Traverse(Usd.TraverseInstanceProxies()) if _is_drawn(prim)]
    meshes = tuple(mesh for mesh in visible if len(mesh.corners))
    if not meshes:
        raise PreviewError(f"{path} shows no mesh")
    start, end = stage.GetStartTimeCode(), stage.GetEndTimeCode()
    return StageScene(_title(stage, Path(path)), start, end, stage.GetTimeCodesPerSecond(), meshes, stage)


def _title(stage: Any, path: Path) -> str:
    """Return the first line of the stage's documentation, or the name of its root or file."""
    documented = stage.GetRootLayer().documentation.partition("\n")[0]
    root = stage.GetDefaultPrim()
    return str(documented or (root.GetName() if root else path.stem))


def _is_drawn(prim: Any) -> bool:
    """Tell whether a renderer shows a prim: a visible mesh, no guide and no proxy."""
    if not prim.IsA(UsdGeom.Mesh):
        return False
    image = UsdGeom.Imageable(prim)
    shown = image.ComputePurpose() in {UsdGeom.Tokens.default_, UsdGeom.Tokens.render}
    return shown and image.ComputeVisibility() != UsdGeom.Tokens.invisible


def _stage_mesh(prim: Any) -> StageMesh:
    mesh = UsdGeom.Mesh(prim)
    first = Usd.TimeCode.EarliestTime()
    counts = np.asarray(mesh.GetFaceVertexCountsAttr().Get(first) or [], dtype=np.int64)
    corners = np.asarray(mesh.GetFaceVertexIndicesAttr().Get(first) or [], dtype=np.int64)
    if counts.sum() != len(corners):
        raise PreviewError(f"{prim.GetPath()} has {len(corners)} corners but its faces need {counts.sum()}")
    colors = face_colors(mesh, counts, corners)
    if mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded:
        corners = _reversed_faces(counts, corners)
    return StageMesh(str(prim.GetPath()), counts, corners, colors, prim)


def _reversed_faces(counts: npt.NDArray[np.int64], corners: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    first = np.repeat(np.cumsum(counts) - counts, counts)
    last = first + np.repeat(counts, counts) - 1
    return np.asarray(corners[first + last - np.arange(len(corners))])
