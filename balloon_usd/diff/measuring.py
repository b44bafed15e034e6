"""Measure how far two surfaces are apart: distances, volumes and extents, time code by time code."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.diff.movement import STILL, Moment, Movement
from balloon_usd.diff.surface import Part, Surface, points_in, surface_of
from balloon_usd.diff.values import same_bits
from balloon_usd.diff.world import Standpoint
from balloon_usd.openusd import Usd, UsdGeom

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    Points = NDArray[np.float64]
    Faces = Sequence[Surface | None]
    Moments = dict[str, list[Moment]]


class Body:
    """The points of a prim in the world, with its faces if it is a mesh."""

    def __init__(self, prim: Any) -> None:
        """Look at points, faces and transforms."""
        self.prim = prim
        self._points = Usd.AttributeQuery(UsdGeom.PointBased(prim).GetPointsAttr())
        self._standpoint = Standpoint(prim)
        mesh = UsdGeom.Mesh(prim) if prim.IsA(UsdGeom.Mesh) else None
        faces = (mesh.GetFaceVertexCountsAttr(), mesh.GetFaceVertexIndicesAttr()) if mesh else ()
        self._changes = any(attribute.ValueMightBeTimeVarying() for attribute in faces)
        self._surface = surface_of(prim, Usd.TimeCode.EarliestTime()) if mesh else None

    def times(self) -> set[float]:
        """Return the time codes at which it may move."""
        return {*self._points.GetTimeSamples(), *self._standpoint.times()}

    def local(self, time: Any) -> NDArray[np.float32]:
        """Return the points (V, 3) in the prim's own space and units."""
        return points_in(self._points.Get(time))

    def matrix(self, time: Any) -> NDArray[np.float64]:
        """Return the way to the world (4, 4) at a time code."""
        return self._standpoint.at(time)

    def surface(self, time: Any, count: int) -> Surface | None:
        """Return the faces between `count` points at a time code, None where there are none."""
        found = surface_of(self.prim, time) if self._changes else self._surface
        return found if found and found.vertex_count <= count else None


@dataclass(frozen=True)
class Measured:
    """What was found of two surfaces."""

    movements: tuple[Movement, ...]
    """Of the whole surface first, then of its bubbles; only those that moved at all."""
    unlike: str
    """What of their points and faces is unlike, such as "1796 and 5010 vertices"; empty if nothing is."""
    compared: int
    """Number of time codes."""


@np.errstate(invalid="ignore", over="ignore")
def measure_surfaces(one: Any, other: Any) -> Measured:
    """Measure how far the surfaces of two prims are apart; extents and volumes alone where they are unlike.

    Args:
        one: point-based prim of the first stage.
        other: of the second stage.
    """
    bodies = Body(one), Body(other)
    times: list[Any] = sorted(bodies[0].times() | bodies[1].times()) or [Usd.TimeCode.Default()]
    found: Moments = {}
    unlike = ""
    for time in times:
        local = [body.local(time) for body in bodies]
        matrices = [body.matrix(time) for body in bodies]
        if same_bits(*local) and np.array_equal(matrices[0], matrices[1]):
            continue
        if not all(map(len, local)):
            unlike = unlike or _counts_text(local, [])
            continue
        world = [_placed(points, matrix) for points, matrix in zip(local, matrices, strict=True)]
        faces = [body.surface(time, len(points)) for body, points in zip(bodies, world, strict=True)]
        code = time if isinstance(time, float) else None
        if _fits(world, faces):
            _measure(code, world, faces, found)
        else:
            unlike = unlike or _counts_text(local, faces)
            _compare_boxes(code, world, faces, found)
    moved = (Movement(part, tuple(moments)) for part, moments in found.items())
    return Measured(tuple(moved), unlike, len(times))


def _placed(points: NDArray[np.float32], matrix: NDArray[np.float64]) -> Points:
    wide = points.astype(np.float64)
    if np.array_equal(matrix, np.eye(4)):
        return wide
    return np.asarray(wide @ matrix[:3, :3] + matrix[3, :3])


def _fits(world: Sequence[Points], faces: Faces) -> bool:
    """Whether points can be compared one by one."""
    return len(world[0]) == len(world[1]) and (faces[0] is None) == (faces[1] is None)


def _measure(code: float | None, world: Sequence[Points], faces: Faces, found: Moments) -> None:
    """Add the distances and volumes of one time code."""
    gap = world[1] - world[0]
    squares = np.einsum("ij,ij->i", gap, gap)
    # What is not finite is told of the attribute, and no distance.
    squares[~np.isfinite(squares)] = 0.0
    volumes = [surface.volumes(points) for surface, points in zip(faces, world, strict=True) if surface]
    for part in _parts(faces):
        mine = squares if part is None or not part.name else squares[part.vertices]
        name = part.name if part else ""
        row = int(mine.argmax())
        if mine[row] <= STILL**2:
            continue
        vertex = int(part.vertices[row]) if part and part.name else row
        rms = float(np.sqrt(mine.mean()))
        moment = Moment(code, float(np.sqrt(mine[row])), vertex, rms, _both(volumes, name))
        found.setdefault(name, []).append(moment)


def _parts(faces: Faces) -> Sequence[Part | None]:
    return faces[0].parts if faces[0] else (None,)


def _compare_boxes(code: float | None, world: Sequence[Points], faces: Faces, found: Moments) -> None:
    """Add the extents and volumes of one time code, of parts that both have."""
    surfaces = [surface for surface in faces if surface]
    volumes = [s.volumes(points) for s, points in zip(faces, world, strict=True) if s]
    vertices = [{part.name: part.vertices for part in surface.parts} for surface in surfaces]
    names = [name for name in vertices[0] if name in vertices[1]] if len(surfaces) == 2 else [""]
    for name in names:
        boxes = []
        for side, points in enumerate(world):
            mine = points[vertices[side][name]] if name else points
            boxes.append(np.stack([mine.min(axis=0), mine.max(axis=0)]))
        apart = float(np.linalg.norm(boxes[1] - boxes[0], axis=1).max())
        found.setdefault(name, []).append(Moment(code, apart, -1, None, _both(volumes, name)))


def _both(volumes: Sequence[dict[str, float]], name: str) -> tuple[float, float] | None:
    if len(volumes) < 2 or any(name not in side for side in volumes):
        return None
    return volumes[0][name], volumes[1][name]


def _counts_text(local: Sequence[NDArray[np.float32]], faces: Faces) -> str:
    text = f"{len(local[0])} and {len(local[1])} vertices"
    counts = [surface.face_count for surface in faces if surface]
    return f"{text}, {counts[0]} and {counts[1]} faces" if len(counts) == 2 else text
