"""Setting a net: leading its joints to their places in space."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.opening import opening_path
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.sculpture import ALONG

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.sculpture import Sculpture

Floats = NDArray[np.float64]


class SetNet(Motion):
    """A net whose joints are led to their places about their middle, with what hangs on them."""

    def __init__(self, move: moves.SetNet, sculpture: Sculpture) -> None:
        """Take hold of its joints, and find their way."""
        self._hands = hands = sculpture.hands
        hands.touch(sculpture.bodies)
        self._joints = np.array([sculpture.joints[ring] for ring in move.rings])
        middle = sculpture.frame.middle
        if move.moving is not None:
            hands.clasp(int(self._joints[-1]), middle)
            hands.grip(sculpture.joints[move.moving], middle)
        for joint in self._joints.tolist():
            hands.lead(joint, middle)
        self._carried = sculpture.carry(move.rings)
        began = middle[self._joints].astype(np.float64)
        onward = None if move.onward is None else np.array(move.onward)
        width = 2.0 * max(sculpture.strip_of(ring).inflated_radius for ring in move.rings)
        self._path = opening_path(began, np.array(move.places), move.sides, onward, width)
        self._rest, self._straight = np.zeros(0, dtype=np.int64), np.zeros((0, 3))
        if onward is not None:
            self._rest, self._straight = _straight_rest(move.rings[-1], sculpture)
            for joint in self._rest.tolist():
                hands.lead(joint, middle)
        if move.moving is not None:
            moving = move.rings.index(move.moving)
            gap = 2.0 * float(hands.neck[self._joints[-1]])
            far = self._path[:, moving] - self._path[:, -1]
            size = np.linalg.norm(far, axis=1)[:, None]
            # On its way the moving ring stops beside the held one.
            coming = far[0] / max(float(size[0, 0]), 1e-9)
            self._path[:, moving] += np.maximum(gap - size, 0.0) * coming
        self._bent = middle[self._rest].astype(np.float64)

    def advance(self, share: float) -> None:
        """Lead the joints a share of their way."""
        progress = smooth(share)
        at = progress * (len(self._path) - 1)
        k = min(int(at), len(self._path) - 2)
        goal = self._path[k] + (at - k) * (self._path[k + 1] - self._path[k])
        self._hands.goal[self._joints] = goal
        self._hands.goal[self._carried.joints] = self._carried.goals(goal - self._path[0])
        carried = goal[-1] - self._path[0][-1]
        self._hands.goal[self._rest] = self._bent + progress * (self._straight - self._bent) + carried


def _straight_rest(held: int, sculpture: Sculpture) -> tuple[NDArray[np.int64], Floats]:
    """Return the joints by which hands lead what is left of a balloon beyond a held ring of the plan, and
    where they are when it is straight, (N, 3), m: bent, it would swing when it is twisted next.
    """
    rings = sculpture.plan.table.rings
    own = [k for k in range(held, len(rings)) if rings[k].balloon == rings[held].balloon]
    joints = np.array([sculpture.joints[k] for k in own])
    places = sculpture.frame.middle[joints].astype(np.float64)
    far = np.cumsum(np.linalg.norm(np.diff(places, axis=0), axis=1))
    return joints[1:], places[0] + far[:, None] * ALONG
