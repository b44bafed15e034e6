"""Bending a bubble towards a side."""

from __future__ import annotations

from abc import ABC
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations import moves
from balloon_usd.solver.motions.curve import Curve, Row
from balloon_usd.solver.placement import unit

if TYPE_CHECKING:
    from balloon_usd.solver.motions.curve import Path

Floats = NDArray[np.float64]


class Bend(Curve[moves.Bend], ABC):
    """A bubble that is led onto an arc."""

    def path(self, move: moves.Bend, straight: tuple[int, int]) -> Path:
        """Return the arc."""
        return Arc(Row(self._began, straight), move.angle, np.array(move.point))


class Arc:
    """A row of rings that is bent into an arc."""

    def __init__(self, row: Row, angle: float, point: Floats) -> None:
        """Take the row as it is.

        `angle`: between the directions of both ends, rad; `point`: unit direction in which the first goes.
        """
        self._row = row
        self._point = unit(point - row.axis * float(point @ row.axis))
        bent = np.clip((row.along - row.begin) / max(row.end - row.begin, 1e-9), 0.0, 1.0)
        self._turn = 0.5 * angle * (bent[1:] + bent[:-1])
        """How far each side is turned in the end, rad."""

    def places(self, progress: float) -> Floats:
        """Return where the rings go, (N, 3), m; `progress`: 0 straight, 1 bent by the whole angle."""
        turn = progress * self._turn[:, None]
        steps = self._row.sides[:, None] * (np.cos(turn) * self._row.axis + np.sin(turn) * self._point)
        row: Floats = self._row.held + np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])
        return row[::-1]
