"""Meshes, particles and their colours and movement from any USD stage."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Pcp, Sdf, Tf, Usd, UsdGeom, usd_access
from balloon_usd.preview.error import PreviewError
from balloon_usd.preview.particles import Particles
from balloon_usd.preview.stage_cloud import StageCloud
from balloon_usd.preview.stage_look import select_look
from balloon_usd.preview.stage_mesh import read_mesh
from balloon_usd.preview.stage_place import World
from balloon_usd.stage.animated import STEP
from balloon_usd.stage.component import in_component
from balloon_usd.stage.on_disk import file_of, special_files
from balloon_usd.stage.opening import quiet

if TYPE_CHECKING:
    from balloon_usd.preview.stage_mesh import StageMesh
    from balloon_usd.preview.subdivide import Points


MISSING_FILE = {Pcp.ErrorType_InvalidAssetPath, Pcp.ErrorType_InvalidSublayerPath}
"""Errors of a composition that lacks a file."""


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

    look: str
    """Selected look; "" for a stage that has none."""
    clouds: tuple[StageCloud, ...] = ()

    @usd_access()
    def points(self, time_code: float) -> list[Points]:
        """Return the points (V, 3) of every mesh at a time code (m, z up).

        Raises:
            PreviewError: a mesh lacks points that its faces name.
        """
        world = World.of(self.stage, time_code)
        return [mesh.points_at(time_code, world) for mesh in self.meshes]

    @usd_access()
    def vertex_colors(self, time_code: float) -> list[Points | None]:
        """Return the linear rgb (V, 3) of every mesh that is painted by vertex, at a time code."""
        return [mesh.vertex_colors_at(time_code) for mesh in self.meshes]

    @usd_access()
    def particles(self, time_code: float) -> Particles:
        """Return the particles of all clouds at a time code.

        Raises:
            PreviewError: a cloud has widths or colours for another number of points.
        """
        world = World.of(self.stage, time_code)
        return Particles.joined([cloud.particles_at(time_code, world) for cloud in self.clouds])

    @usd_access()
    def doing(self, time_code: float) -> str:
        """Return what the hands do at a time code, "" if the stage does not say."""
        root = self.stage.GetDefaultPrim()
        said = root.GetAttribute(STEP).Get(time_code) if root and root.HasAttribute(STEP) else None
        return str(said or "")


@usd_access()
def read_stage(path: str | Path, look: str | None = None) -> StageScene:
    """Open a stage in one of its looks, None for its own, and find its meshes and points.

    `path`: a file, or a folder NAME as `run` writes it. Where there are component models only these are read:
    what stands round them in a shot is scenery.

    Raises:
        PreviewError: the file is not there, no USD file or not whole, has no such look, or shows no mesh.
    """
    path = _file_of(path)
    stage, selected = _opened(path, look)
    drawn = [prim for prim in stage.Traverse(Usd.TraverseInstanceProxies()) if _is_drawn(prim)]
    drawn = [prim for prim in drawn if in_component(prim)] or drawn
    meshes = [read_mesh(prim) for prim in drawn if prim.IsA(UsdGeom.Mesh)]
    clouds = [StageCloud(str(prim.GetPath()), prim) for prim in drawn if prim.IsA(UsdGeom.Points)]
    meshes = [mesh for mesh in meshes if len(mesh.corners)]
    if not meshes:
        raise PreviewError(f"{path} shows no mesh")
    title, (start, end, fps) = _title(stage, Path(path)), _times(stage, path)
    return StageScene(title, start, end, fps, tuple(meshes), stage, selected, tuple(clouds))


def _file_of(path: str | Path) -> str | Path:
    """Return the file that a path stands for, itself where that holds no stage or cannot be looked up."""
    try:
        file = file_of(Path(path))
    except (OSError, ValueError):
        return path
    return file if file.is_file() else path


def _opened(path: str | Path, look: str | None) -> tuple[Any, str]:
    """Open a stage in a look, and return that too, without what USD prints of layers that are missing."""
    if not _is_file(Path(path)):
        raise PreviewError(f"{path} is not a file")
    try:
        with quiet():
            layer = Sdf.Layer.FindOrOpen(str(path))
            if layer is None:
                raise PreviewError(f"{path} is not a USD file, or a damaged one")
            for asset, by in special_files(layer):
                raise PreviewError(f"{path} is not whole: {asset}, which {by} needs, is a pipe or a device")
            stage = Usd.Stage.Open(layer)
            _require_whole(stage, path)
            selected = select_look(stage, look, path)
            _require_whole(stage, path)
    except Tf.ErrorException as error:
        raise PreviewError(f"{path} is not a USD file") from error
    return stage, selected


def _require_whole(stage: Any, path: str | Path) -> None:
    """Refuse a stage that lacks a file which it is composed of."""
    for error in stage.GetCompositionErrors():
        if error.errorType in MISSING_FILE:
            raise PreviewError(f"{path} is not whole: {' '.join(str(error).split())}")


def _times(stage: Any, path: str | Path) -> tuple[float, float, float]:
    """Return the first and last time code and the rate."""
    start, end, rate = stage.GetStartTimeCode(), stage.GetEndTimeCode(), stage.GetTimeCodesPerSecond()
    if not (isfinite(start) and isfinite(end)):
        raise PreviewError(f"{path} has the time codes {start:g} to {end:g}")
    if not 0.0 < rate < inf:
        raise PreviewError(f"{path} has {rate:g} time codes per second")
    return start, max(start, end), rate


def _title(stage: Any, path: Path) -> str:
    """Return the first line of the stage's documentation, or the name of its root or file."""
    documented = stage.GetRootLayer().documentation.partition("\n")[0]
    root = stage.GetDefaultPrim()
    return str(documented or (root.GetName() if root else path.stem))


def _is_drawn(prim: Any) -> bool:
    """Tell whether a renderer shows a prim: a visible mesh or points, no guide and no proxy."""
    if not (prim.IsA(UsdGeom.Mesh) or prim.IsA(UsdGeom.Points)):
        return False
    image = UsdGeom.Imageable(prim)
    shown = image.ComputePurpose() in {UsdGeom.Tokens.default_, UsdGeom.Tokens.render}
    return shown and image.ComputeVisibility() != UsdGeom.Tokens.invisible


def _is_file(path: Path) -> bool:
    """Whether a path leads to a file; too long a name leads nowhere."""
    try:
        return path.is_file()
    except OSError:
        return False
