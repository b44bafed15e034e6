"""Bringing a joint of one balloon to a joint of another."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import unit

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.sculpture import Sculpture


FOLLOWING = 0.45
"""Way of a ring, in lengths of what hangs on it, up to which that follows by its own rubber."""


class Bring(Motion):
    """A ring on its way to another, which is held.

    What hangs on both follows by its own rubber, unless it is carried and goes far: a balloon that is brought
    to a net by its knot would stay behind, bent into a hairpin, which the next twist swings round. Carried
    over a short way, balloons side by side would come to lie on each other.
    """

    def __init__(self, move: moves.Bring, sculpture: Sculpture) -> None:
        """Take hold of both rings."""
        self._hands = sculpture.hands
        self._joint, held = sculpture.joints[move.ring], sculpture.joints[move.to]
        self._hands.touch(sculpture.bodies)
        for joint in (self._joint, held):
            self._hands.grip(joint, sculpture.frame.middle)
        self._here, there = sculpture.frame.middle[[self._joint, held]].astype(np.float64)
        self._goal = there + unit(self._here - there) * 2.0 * float(self._hands.neck[held])
        hanging, _ = sculpture.hanging_on((move.ring, move.to))
        length = np.linalg.norm(sculpture.frame.middle[hanging] - self._here, axis=1).max(initial=0.0)
        far = move.carried and float(np.linalg.norm(self._goal - self._here)) > FOLLOWING * float(length)
        self._carried = sculpture.carry((move.ring, move.to)) if far else None

    def advance(self, share: float) -> None:
        """Bring the ring a share of the way."""
        shift = smooth(share) * (self._goal - self._here)
        self._hands.goal[self._joint] = self._here + shift
        if self._carried is not None:
            self._hands.goal[self._carried.joints] = self._carried.goals(shift[None])
