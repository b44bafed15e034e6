"""Leading a bubble onto a curve, of which it keeps a part."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations import moves
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import unit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.solver.sculpture import Sculpture

Floats = NDArray[np.float64]
AMove = TypeVar("AMove", bound=moves.Curve)


class Row:
    """A row of rings, measured from its last one, which is held."""

    def __init__(self, began: Floats, straight: tuple[int, int] = (0, 0)) -> None:
        """Take the rings as they are, (N, 3), m; `straight`: how many at either end lie beyond the curve."""
        self.sides: Floats = np.linalg.norm(np.diff(began, axis=0), axis=1)[::-1]
        """Lengths between its rings, from the held one on, (N - 1,), m."""
        self.along: Floats = np.concatenate([[0.0], np.cumsum(self.sides)])
        """How far along it each ring lies, from the held one on, (N,), m."""
        self.axis = unit(began[0] - began[-1])
        """Unit direction from the held ring to the first one."""
        self.held: Floats = began[-1]
        """Where the held ring is, m."""
        self.begin = float(self.along[straight[1]])
        """Where the curve begins, m."""
        self.end = float(self.along[len(self.sides) - straight[0]])
        """Where it ends, m."""


class Path(Protocol):
    """Where the rings of a row go."""

    def places(self, progress: float) -> Floats:
        """Return where the rings go, (N, 3), m, in the order of the row; `progress`: from 0 to 1."""


class Curve(Motion, ABC, Generic[AMove]):
    """A bubble that is led onto a curve: the end on which more hangs stays, and what hangs on the other goes
    along.
    """

    progress: float = 0.0
    """How far it is along by the end of the coming frame, 0 to 1."""

    def __init__(self, move: AMove, sculpture: Sculpture) -> None:
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
        self.take_flat([sculpture.joints[ring] for ring in move.rings[firm:]])
        self._carried = sculpture.carry(rings)
        self._began = sculpture.frame.middle[self._joints].astype(np.float64)
        self._path = self.path(move, flat)
        self._before = self._began - self._path.places(0.0) if move.again else np.zeros(3)
        """How its rings lie beside the straight line from which a path begins, m."""

    def _rubber_on(self, ring: int, rings: Sequence[int]) -> float:
        """Return the unstressed length of all bubbles that hang on one of the bubble's rings, m."""
        plan = self._sculpture.plan
        hanging = set(self._sculpture.rings_hanging_on(rings)[rings.index(ring)])
        return sum(each.rest_length for each in plan.bubbles if hanging & set(plan.table.guides(each.name)))

    @abstractmethod
    def path(self, move: AMove, straight: tuple[int, int]) -> Path:
        """Return where the rings go, the last of which is held; `straight`: as of `Row`."""

    def take(self, joint: int) -> None:
        """Take hold of a ring of the bubble."""
        self._hands.lead(joint, self._sculpture.frame.middle)

    def take_flat(self, joints: Sequence[int]) -> None:
        """Take hold of the rings on a flat tail: held firmly, it whips, and fills with gas."""
        for joint in joints:
            self._hands.lead(joint, self._sculpture.frame.middle)

    def advance(self, share: float) -> None:
        """Lead the rings of the bubble along, and let it keep its curve in the end."""
        self.progress = progress = smooth(share)
        goal = self._path.places(progress) + (1.0 - progress) * self._before
        self._hands.goal[self._joints] = goal
        self._hands.goal[self._carried.joints] = self.carried(goal)
        if share >= 1.0:
            self.set_bend(self._bubble)

    def carried(self, goal: Floats) -> Floats:
        """Return where what hangs on the bubble goes, (M, 3), m; `goal`: where its rings go, (N, 3), m."""
        return self._carried.goals(goal - self._began)

    @abstractmethod
    def set_bend(self, bubble: str) -> None:
        """Let a bubble that was bent keep part of its curve."""
