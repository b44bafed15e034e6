"""A frame as the stage stores it: one value for each attribute that moves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.stage.description import (
        AirDescription,
        MeshDescription,
        StageDescription,
        StageFrame,
    )


@dataclass(frozen=True)
class MeshPose:
    """One mesh at one time code."""

    points: NDArray[np.float32]
    """Positions (V, 3) [m]."""
    extent: NDArray[np.float32]
    """Smallest and largest corner of the points (2, 3) [m]."""
    stretch: NDArray[np.float32]
    """Largest principal stretch at the vertices (V,)."""
    pressure: NDArray[np.float32]
    """Gauge pressure behind the wall at the vertices (V,) [Pa]."""


@dataclass(frozen=True)
class AirPose:
    """The air of one balloon at one time code."""

    points: NDArray[np.float32]
    """Positions (P, 3) [m]."""
    extent: NDArray[np.float32]
    """Smallest and largest corner of the drawn particles (2, 3) [m]."""
    cluster: NDArray[np.int32]
    """Bubble of each particle (P,)."""


@dataclass(frozen=True)
class Pose:
    """The whole sculpture at one time code."""

    meshes: tuple[MeshPose, ...]
    airs: tuple[AirPose, ...]
    pressure: NDArray[np.float32]
    """Gauge pressure of each bubble (B,) [Pa]."""
    volume: NDArray[np.float32]
    """Gas volume of each bubble (B,) [m3]."""

    @property
    def extent(self) -> NDArray[np.float32]:
        """Smallest and largest corner of all meshes and particles (2, 3) [m]."""
        return reduce(union, [*(mesh.extent for mesh in self.meshes), *(air.extent for air in self.airs)])

    @property
    def size(self) -> int:
        """Memory of the arrays [B]."""
        arrays = [array for mesh in self.meshes for array in (mesh.points, mesh.stretch, mesh.pressure)]
        arrays += [air.points for air in self.airs]
        return sum(array.nbytes for array in (*arrays, self.pressure, self.volume))


def pose_of(frame: StageFrame, description: StageDescription) -> Pose:
    """The values that the attributes take at the frame's time code, copied from the frame."""
    meshes = zip(description.meshes, frame.points, frame.stretch, strict=True)
    return Pose(
        meshes=tuple(
            MeshPose(
                points=points.copy(),
                extent=extent_of(points),
                stretch=stretch.copy(),
                pressure=_at_vertices(frame.pressure[description.numbers_of(mesh)], mesh),
            )
            for mesh, points, stretch in meshes
        ),
        airs=_air_poses(frame, description.airs),
        pressure=frame.pressure.copy(),
        volume=frame.volume.copy(),
    )


def _air_poses(frame: StageFrame, airs: tuple[AirDescription, ...]) -> tuple[AirPose, ...]:
    if not airs:
        return ()
    return tuple(
        AirPose(points.copy(), extent_of_balls(points, air.width), cluster.copy())
        for air, points, cluster in zip(airs, frame.air, frame.cluster, strict=True)
    )


def extent_of(points: NDArray[np.float32]) -> NDArray[np.float32]:
    """Smallest and largest corner (2, 3) of points (V, 3)."""
    # NumPy reduces long rows about forty times as fast as a long narrow array's columns.
    rows = np.ascontiguousarray(points.T)
    return np.array([rows.min(axis=1), rows.max(axis=1)])


def extent_of_balls(points: NDArray[np.float32], width: float) -> NDArray[np.float32]:
    """Smallest and largest corner (2, 3) of balls of one diameter at points (P, 3)."""
    radius = np.float32(0.5 * width)
    return extent_of(points) + np.stack([-radius, radius])[:, None]


def union(one: NDArray[np.float32], other: NDArray[np.float32]) -> NDArray[np.float32]:
    """Extent (2, 3) that holds both extents (2, 3)."""
    return np.array([np.minimum(one[0], other[0]), np.maximum(one[1], other[1])])


def _at_vertices(per_bubble: NDArray[np.float32], mesh: MeshDescription) -> NDArray[np.float32]:
    """Mean over the quads around each vertex: at a joint, the mean of the two bubbles."""
    found = per_bubble.take(mesh.vertex_bubble)
    seam = mesh.seam
    total = np.bincount(seam.place, weights=per_bubble.take(seam.bubble), minlength=len(seam.vertices))
    found[seam.vertices] = total / seam.quads
    return found
