"""From a prim's own space to metres with z up."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom

if TYPE_CHECKING:
    import numpy.typing as npt

    from balloon_usd.preview.subdivide import Points

Y_UP_TO_Z_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""Turns row vectors of a stage whose y points up."""


@dataclass(frozen=True)
class World:
    """The world of a stage at one time code."""

    to_world: Any
    """A `UsdGeom.XformCache`."""
    scale: float
    """Metres per unit."""
    turn: npt.NDArray[np.float64]
    """(3, 3), applied to row vectors."""

    @classmethod
    def of(cls, stage: Any, time_code: float) -> World:
        """Return the world of a `Usd.Stage` at a time code."""
        z_up = UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z
        scale = UsdGeom.GetStageMetersPerUnit(stage)
        return cls(UsdGeom.XformCache(time_code), scale, np.eye(3) if z_up else Y_UP_TO_Z_UP)

    def place(self, prim: Any, points: npt.NDArray[np.float64]) -> Points:
        """Move points (N, 3) of a prim into the world (m, z up)."""
        matrix = self._matrix(prim)
        moved = points @ matrix[:3, :3] + matrix[3, :3]
        return np.asarray(self.scale * moved @ self.turn, dtype=np.float32)

    def enlarge(self, prim: Any, lengths: npt.NDArray[np.float64]) -> npt.NDArray[np.float32]:
        """Turn lengths (N,) in a prim's space into metres; the mean where its axes are scaled unlike."""
        x, y, z = self._matrix(prim)[:3, :3]
        volume = abs(float(np.dot(np.cross(x, y), z)))
        return np.asarray(self.scale * np.cbrt(volume) * lengths, dtype=np.float32)

    def _matrix(self, prim: Any) -> npt.NDArray[np.float64]:
        return np.asarray(self.to_world.GetLocalToWorldTransform(prim))
