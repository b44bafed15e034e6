"""Where a prim stands in the world: metres, z up, whatever the stage's own units and axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom

if TYPE_CHECKING:
    from numpy.typing import NDArray

Y_UP_TO_Z_UP = np.array(
    [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
)
"""Turns row vectors of a stage whose y points up."""


class Standpoint:
    """The way from a prim's own space to the world, at any time code."""

    def __init__(self, prim: Any) -> None:
        """Look at the prims above, too."""
        stage = prim.GetStage()
        scale = UsdGeom.GetStageMetersPerUnit(stage)
        turn = np.eye(4) if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z else Y_UP_TO_Z_UP
        self._prim = prim
        self._to_metres = np.diag([scale, scale, scale, 1.0]) @ turn
        self._chain = _xformables(prim)
        moves = any(xform.TransformMightBeTimeVarying() for xform in self._chain)
        self._still = None if moves else self._matrix(UsdGeom.XformCache())

    def at(self, time: float) -> NDArray[np.float64]:
        """Return the matrix (4, 4) that moves row vectors at a time code (to m, z up)."""
        return self._matrix(UsdGeom.XformCache(time)) if self._still is None else self._still

    def times(self) -> list[float]:
        """Return the time codes at which a prim above, or this one, has a sample of its transform."""
        return sorted({time for xform in self._chain for time in xform.GetTimeSamples()})

    def _matrix(self, cache: Any) -> NDArray[np.float64]:
        local = np.asarray(cache.GetLocalToWorldTransform(self._prim))
        return np.asarray(local @ self._to_metres)


def _xformables(prim: Any) -> list[Any]:
    found = []
    while prim and not prim.IsPseudoRoot():
        if prim.IsA(UsdGeom.Xformable):
            found.append(UsdGeom.Xformable(prim))
        prim = prim.GetParent()
    return found
