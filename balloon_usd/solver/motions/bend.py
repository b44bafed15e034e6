"""Bending a bubble towards a side."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.operations import moves
    from balloon_usd.solver.sculpture import Sculpture

Floats = NDArray[np.float64]


class Bend(Motion, ABC):
    """A bubble that is led onto an arc: the end on which more hangs stays, and what hangs on the other goes
    along.
    """

    def __init__(self, move: moves.Bend, sculpture: Sculpture) -> None:
        """Take hold of the bubble and of what hangs on it."""
        self._sculpture, self._hands = sculpture, sculpture.hands
        self._bubble = sculpture.plan.table.rings[move.rings[1]].bubble
        rings, flat = move.rings, (0, move.flat)
        if self._rubber_on(rings[-1], rings) < self._rubber_on(rings[0], rings):
            rings, flat = rings[::-1], flat[::-1]
        self._joints = [sculpture.joints[ring] for ring in rings]
        firm = len(move.rings) - move.flat
        for ring in move.rings[:firm]:
            self.take(sculpture.joints[ring])
        for ring in move.rings[firm:]:
            # Held firmly, what is beyond whips, and fills with gas.
            self._hands.lead(sculpture.joints[ring], sculpture.frame.middle)
        self._carried = sculpture.carry(rings)
        self._began = sculpture.frame.middle[self._joints].astype(np.float64)
        self._arc = Arc(self._began, move.angle, np.array(move.point), flat)

    def _rubber_on(self, ring: int, rings: Sequence[int]) -> float:
        """Return the unstressed length of all bubbles that hang on one of the bubble's rings, m."""
        plan = self._sculpture.plan
        hanging = set(self._sculpture.rings_hanging_on(rings)[rings.index(ring)])
        return sum(each.rest_length for each in plan.bubbles if hanging & set(plan.table.guides(each.name)))

    def take(self, joint: int) -> None:
        """Take hold of a ring of the bubble."""
        self._hands.lead(joint, self._sculpture.frame.middle)

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

    def __init__(
        self, began: Floats, angle: float, point: Floats, straight: tuple[int, int] = (0, 0)
    ) -> None:
        """Take the rings as they are, (N, 3), m.

        `angle`: between the directions of both ends, rad; `point`: unit direction in which the first goes;
        `straight`: how many rings at either end lie beyond the bend.
        """
        sides = np.linalg.norm(np.diff(began, axis=0), axis=1)[::-1]
        self._axis = began[0] - began[-1]
        self._axis /= max(float(np.linalg.norm(self._axis)), 1e-9)
        self._point = point - self._axis * float(point @ self._axis)
        self._point /= max(float(np.linalg.norm(self._point)), 1e-9)
        along = np.concatenate([[0.0], np.cumsum(sides)])
        begin, end = along[straight[1]], along[len(sides) - straight[0]]
        bent = np.clip((along - begin) / max(end - begin, 1e-9), 0.0, 1.0)
        self._turn = 0.5 * angle * (bent[1:] + bent[:-1])
        """How far each side is turned in the end, rad."""
        self._sides, self._held = sides[:, None], began[-1]

    def places(self, progress: float) -> Floats:
        """Return where the rings go, (N, 3), m; `progress`: 0 straight, 1 bent by the whole angle."""
        turn = progress * self._turn[:, None]
        steps = self._sides * (np.cos(turn) * self._axis + np.sin(turn) * self._point)
        row: Floats = self._held + np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])
        return row[::-1]
