"""Bringing a joint of one balloon to a joint of another."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.sculpture import ALONG

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.operations import moves
    from balloon_usd.solver.sculpture import Sculpture


class Bring(Motion):
    """A ring on its way to another, which is held.

    What hangs on the ring goes along, until both balloons lie side by side; what hangs on the held one stays.
    """

    def __init__(self, move: moves.Bring, sculpture: Sculpture) -> None:
        """Take hold of both rings and of what hangs on them."""
        self._hands = sculpture.hands
        self._joint, held = sculpture.joints[move.ring], sculpture.joints[move.to]
        self._hands.touch(sculpture.bodies)
        for joint in (self._joint, held):
            self._hands.grip(joint, sculpture.frame.middle)
        self._carried = sculpture.carry((move.ring, move.to))
        self._here, there = sculpture.frame.middle[[self._joint, held]].astype(np.float64)
        away = (self._here - there) / max(float(np.linalg.norm(self._here - there)), 1e-9)
        gap = 2.0 * float(self._hands.neck[held])
        self._goal = there + away * gap
        width = sum(sculpture.strip_of(ring).inflated_radius for ring in (move.ring, move.to))
        self._carried_way = _way_beside(self._goal - self._here, width - gap)

    def advance(self, share: float) -> None:
        """Bring the ring, and what hangs on it, a share of the way."""
        progress = smooth(share)
        self._hands.goal[self._joint] = self._here + progress * (self._goal - self._here)
        self._hands.goal[self._carried.joints] = self._carried.goals(progress * self._carried_way[None])


def _way_beside(way: NDArray[np.float64], room: float) -> NDArray[np.float64]:
    """Return the part of a way (3,), m, that leaves some room (m) across balloons that lie along x."""
    across = way - ALONG * float(way @ ALONG)
    return way - across * min(1.0, room / max(float(np.linalg.norm(across)), 1e-9))
