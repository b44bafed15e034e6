"""The walls of a stage as one surface: its closed meshes, their bubbles and necks, and their points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.balloon.tube_mesh import MIRRORED_FACE
from balloon_usd.check.necks import Necks, necks_of
from balloon_usd.check.opening import UnreadableError
from balloon_usd.openusd import Usd, UsdGeom
from balloon_usd.quality.walls import Walls, walls_from
from balloon_usd.stage.animated import BUBBLES
from balloon_usd.stage.properties.reading import first_value, meshes_of, sculpted, value_at

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from balloon_usd.check.necks import Neck

    Numbers = NDArray[np.int64]
    Floats = NDArray[np.float64]


@dataclass(frozen=True)
class WallMesh:
    """One closed mesh, its faces cut into quads; a triangle is a quad whose last corner is there twice."""

    schema: Any
    """A `UsdGeom.Mesh`."""
    vertices: int
    """Number of its points V."""
    quads: Numbers
    """(F, 4) vertices, counter-clockwise from outside."""
    bubbles: Numbers
    """Of each quad (F,), counted in `names`."""
    names: tuple[str, ...]
    owner: str
    """Prim that says so, the sculpture; the mesh itself where none does."""
    necks: list[Neck]

    @property
    def path(self) -> str:
        """Path of the prim."""
        return str(self.schema.GetPath())

    def points(self, time_code: float | None, scale: float) -> NDArray[np.float32]:
        """Return where the vertices are, (V, 3) float32 m; `scale`: metres in a unit.

        Raises:
            UnreadableError: their number changes, or some are no numbers.
        """
        points = value_at(self.schema.GetPointsAttr(), time_code)
        when = "" if time_code is None else f" at time code {time_code:g}"
        if points.shape != (self.vertices, 3):
            raise UnreadableError(f"{self.path}: the number of points changes{when}")
        if not np.isfinite(points).all():
            raise UnreadableError(f"{self.path}: some points are no numbers{when}")
        code = Usd.TimeCode.Default() if time_code is None else time_code
        matrix = np.array(UsdGeom.XformCache(code).GetLocalToWorldTransform(self.schema.GetPrim()))
        if scale != 1.0 or not np.array_equal(matrix, np.eye(4)):
            points = scale * (points.astype(np.float64) @ matrix[:3, :3] + matrix[3, :3])
        return np.ascontiguousarray(points, dtype=np.float32)


class StageWalls:
    """All closed meshes of an open stage; in a shot those of its sculptures."""

    def __init__(self, stage: Any) -> None:
        """Read everything that does not move; in a stage of a shot, the scene around the figures is left out.

        Raises:
            UnreadableError: there is no closed mesh, or a mesh is damaged.
        """
        self._scale = UsdGeom.GetStageMetersPerUnit(stage)
        self.meshes: list[WallMesh] = []
        self.left_out: list[str] = []
        """Paths of meshes that are not closed, or whose topology changes."""
        for mesh in sculpted(stage, meshes_of(stage)):
            found = _wall_mesh(mesh)
            if found is None:
                self.left_out.append(str(mesh.GetPath()))
            else:
                self.meshes.append(found)
        if not self.meshes:
            raise UnreadableError("has no closed mesh")
        times = {t for mesh in self.meshes for t in mesh.schema.GetPointsAttr().GetTimeSamples()}
        self.times: list[float | None] = sorted(times) or [None]
        """Time codes at which points are given; None of a stage that stands still."""
        self.walls = self._walls()

    def points(self, time_code: float | None) -> list[NDArray[np.float32]]:
        """Return where the vertices of all meshes are, (V, 3) float32 m each; raises `UnreadableError`."""
        return [mesh.points(time_code, self._scale) for mesh in self.meshes]

    def necks_in(self, points: list[NDArray[np.float32]]) -> Numbers:
        """Return the joint in whose neck each vertex lies in a frame, (V,); `points`: of all meshes, m."""
        return self._necks.joints_in(np.concatenate(points).astype(np.float64))

    def _walls(self) -> Walls:
        quads, bubbles = [], []
        necks: list[Neck] = []
        names: list[str] = []
        before = 0
        several = len({mesh.owner for mesh in self.meshes if len(mesh.names) > 1}) > 1
        for mesh in self.meshes:
            quads.append(mesh.quads + before)
            bubbles.append(mesh.bubbles + len(names))
            necks += [neck.moved(before) for neck in mesh.necks]
            names += [f"{mesh.owner}.{name}" for name in mesh.names] if several else mesh.names
            before += mesh.vertices
        last = np.concatenate(self.points(self.times[-1])).astype(np.float64)
        self._necks = Necks(necks, last)
        sides = [side for neck in necks for side in neck.sides]
        joint = self._necks.joints_in(last)
        return walls_from(np.concatenate(quads), np.concatenate(bubbles), joint, tuple(names), sides)


def _wall_mesh(mesh: Any) -> WallMesh | None:
    """Return a mesh as quads; None if it is not closed, or its topology changes.

    Raises:
        UnreadableError: its faces do not fit its points.
    """
    counts = first_value(mesh.GetFaceVertexCountsAttr()).astype(np.int64)
    corners = first_value(mesh.GetFaceVertexIndicesAttr()).astype(np.int64)
    first = first_value(mesh.GetPointsAttr())
    path = str(mesh.GetPath())
    damaged = len(counts) == 0 or counts.min() < 3 or counts.sum() != len(corners)
    if damaged or first.ndim != 2 or corners.min() < 0 or corners.max() >= len(first):
        raise UnreadableError(f"{path}: its faces do not fit its points")
    if mesh.GetFaceVertexIndicesAttr().GetNumTimeSamples() > 1 or not _is_closed(counts, corners):
        return None
    quads, face = _quads(counts, corners)
    owner, names, bubbles = _bubbles(mesh, len(counts))
    st = value_at(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st").GetAttr(), None)
    fits = st.shape == (len(corners), 2) and (counts == 4).all()
    necks = necks_of(quads, st.reshape(-1, 4, 2), bubbles, first.astype(np.float64)) if fits else []
    if mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded:
        quads = quads[:, MIRRORED_FACE]
    return WallMesh(mesh, len(first), quads, bubbles[face], names, owner, necks)


def _is_closed(counts: Numbers, corners: Numbers) -> bool:
    """Tell whether every side of a face is the side of one other, which runs along it the other way."""
    starts = np.cumsum(counts) - counts
    following = np.arange(len(corners)) + 1
    following[starts + counts - 1] = starts
    size = int(corners.max()) + 1
    sides = corners * size + corners[following]
    back = corners[following] * size + corners
    return len(np.unique(sides)) == len(sides) and np.array_equal(np.sort(sides), np.sort(back))


def _quads(counts: Numbers, corners: Numbers) -> tuple[Numbers, Numbers]:
    """Return faces as quads (F, 4), in fans where they have more corners, and the face of each (F,)."""
    starts = np.cumsum(counts) - counts
    quads, faces = [], []
    for step in range(1, int(counts.max()) - 1, 2):
        large = np.flatnonzero(counts > step + 1)
        first, last = starts[large], starts[large] + counts[large] - 1
        third = first + step + 1
        picked = np.stack([first, first + step, third, np.minimum(third + 1, last)], axis=1)
        quads.append(corners[picked])
        faces.append(large)
    return np.concatenate(quads), np.concatenate(faces)


def _bubbles(mesh: Any, faces: int) -> tuple[str, tuple[str, ...], Numbers]:
    """Return the owner and the names of a mesh's bubbles, and the bubble of each face.

    A mesh without bubbles is one itself.
    """
    prim = mesh.GetPrim()
    numbers = value_at(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("bubble").GetAttr(), None)
    owner = next((parent for parent in _upwards(prim) if _names(parent)), prim)
    names = _names(owner)
    if names and numbers.shape == (faces,) and numbers.min() >= 0 and numbers.max() < len(names):
        return owner.GetName(), names, numbers.astype(np.int64)
    return prim.GetName(), (prim.GetName(),), np.zeros(faces, dtype=np.int64)


def _names(prim: Any) -> tuple[str, ...]:
    value = prim.GetAttribute(BUBBLES).Get() if prim.HasAttribute(BUBBLES) else None
    return tuple(str(name) for name in value or ())


def _upwards(prim: Any) -> Iterator[Any]:
    while prim:
        yield prim
        prim = prim.GetParent()
