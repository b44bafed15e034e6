"""Bringing a joint of one balloon to a joint of another."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.sculpture import Sculpture


class Bring(Motion):
    """A ring on its way to another, which is held; both hands take along, or keep, what hangs on theirs."""

    def __init__(self, move: moves.Bring, sculpture: Sculpture) -> None:
        """Take hold of both rings and of what hangs on them."""
        self._hands = sculpture.hands
        self._joint, held = sculpture.joints[move.ring], sculpture.joints[move.to]
        self._hands.touch(sculpture.bodies)
        self._hands.grip(self._joint, sculpture.frame.middle)
        self._hands.grip(held, sculpture.frame.middle)
        self._carried = sculpture.carry((move.ring, move.to))
        self._here, there = sculpture.frame.middle[[self._joint, held]].astype(np.float64)
        away = (self._here - there) / max(float(np.linalg.norm(self._here - there)), 1e-9)
        self._way = there + away * 2.0 * float(self._hands.neck[held]) - self._here

    def advance(self, share: float) -> None:
        """Bring the ring, and what hangs on it, a share of the way."""
        shift = smooth(share) * self._way
        self._hands.goal[self._joint] = self._here + shift
        self._hands.goal[self._carried.joints] = self._carried.goals(shift[None])
