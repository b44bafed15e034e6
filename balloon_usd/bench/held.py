"""Vertices that hands hold in a task that other solvers do, too."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from balloon_usd.bench.pinch_task import Floats, Ints


class Held(ABC):
    """Vertices that are drawn to the x axis and turned about it."""

    def __init__(self, index: Ints, points: Floats) -> None:
        """Hold vertices of these indices, (H,), among `points` (V, 3), m."""
        self.index = index.astype(np.int32)
        self._start = points[index].astype(np.float64)

    @abstractmethod
    def at(self, frame: float) -> tuple[Floats, Floats]:
        """Return the distance from the axis, in that at the start, and the turn (radians) of every one.

        Both are (H,), at a time in frames; 0 is before the first.
        """

    def places(self, frame: float) -> Floats:
        """Return where they are at a time in frames, (H, 3), m."""
        drawn, turn = self.at(frame)
        start = self._start
        c, s = np.cos(turn), np.sin(turn)
        y, z = c * start[:, 1] - s * start[:, 2], s * start[:, 1] + c * start[:, 2]
        return np.column_stack([start[:, 0], drawn * y, drawn * z])
