"""Bending a bubble towards a side."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.sculpture import Sculpture

Floats = NDArray[np.float64]


class Bend(Motion, ABC):
    """A bubble that is led onto an arc: its end stays, its start goes, and what hangs on it goes along."""

    def __init__(self, move: moves.Bend, sculpture: Sculpture) -> None:
        """Take hold of the bubble and of what hangs on it."""
        self._hands = sculpture.hands
        self._bubble = sculpture.plan.table.rings[move.rings[1]].bubble
        self._joints = [sculpture.joints[ring] for ring in move.rings]
        for joint in self._joints:
            self._hands.lead(joint, sculpture.frame.middle)
        self._carried = sculpture.carry(move.rings)
        self._began = sculpture.frame.middle[self._joints].astype(np.float64)
        self._arc = Arc(self._began, move.angle, np.array(move.point))

    def advance(self, share: float) -> None:
        """Lead the rings of the bubble along, and let it keep its curve in the end."""
        goal = self._arc.places(smooth(share))
        self._hands.goal[self._joints] = goal
        self._hands.goal[self._carried.joints] = self._carried.goals(goal - self._began)
        if share >= 1.0:
            self.set_bend(self._bubble)

    @abstractmethod
    def set_bend(self, bubble: str) -> None:
        """Let a bubble that was bent keep part of its curve."""


class Arc:
    """A row of rings that is bent into an arc, its last one held."""

    def __init__(self, began: Floats, angle: float, point: Floats) -> None:
        """Take the rings as they are, (N, 3), m.

        `angle`: between the directions of both ends, rad; `point`: unit direction in which the first goes.
        """
        sides = np.linalg.norm(np.diff(began, axis=0), axis=1)
        self._axis = began[0] - began[-1]
        self._axis /= max(float(np.linalg.norm(self._axis)), 1e-9)
        self._point = point - self._axis * float(point @ self._axis)
        self._point /= max(float(np.linalg.norm(self._point)), 1e-9)
        self._along = np.concatenate([[0.0], np.cumsum(sides[::-1])])
        self._sides, self._held, self._angle = sides[::-1, None], began[-1], angle

    def places(self, progress: float) -> Floats:
        """Return where the rings go, (N, 3), m; `progress`: 0 straight, 1 bent by the whole angle."""
        along = self._along
        turn = progress * self._angle * (along[1:] + along[:-1]) / (2.0 * along[-1])
        steps = self._sides * (np.cos(turn)[:, None] * self._axis + np.sin(turn)[:, None] * self._point)
        row: Floats = self._held + np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])
        return row[::-1]
