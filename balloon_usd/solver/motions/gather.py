"""Gathering: bringing both ends of a chain of bubbles together."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.motions.chains import Chain, Cheeks
from balloon_usd.solver.motions.closing import ClosingChain
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.sculpture import ALONG

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.sculpture import Sculpture

Floats = NDArray[np.float64]

BENT = math.radians(40.0)
"""Angle by which hands bend the bubble before an ear away from it, rad."""


class Gather(Motion):
    """A chain of bubbles whose first ring is brought to its last, with what hangs on it."""

    def __init__(self, move: moves.Gather, sculpture: Sculpture) -> None:
        """Take hold of the corners of the chain, of what is beside it and of what hangs on it."""
        self._hands = hands = sculpture.hands
        hands.touch(sculpture.bodies)
        corners = [sculpture.joints[ring] for ring in move.corners]
        held, moving = corners[-1], corners[0]
        hands.clasp(held, sculpture.frame.middle)
        hands.grip(moving, sculpture.frame.middle)
        for joint in [*corners[1:-1], *(sculpture.joints[ring] for ring, _ in move.cheeks)]:
            hands.lead(joint, sculpture.frame.middle)
        # The other hand keeps what hangs on the held end, and the open rest, from swinging.
        carried = sculpture.carry(move.corners)
        began = sculpture.frame.middle[corners].astype(np.float64)
        sides = np.maximum(np.linalg.norm(np.diff(began, axis=0), axis=1), 1e-3)
        gap = 2.0 * float(hands.neck[held])
        if move.pulled:
            hands.pull(corners[1])
            sides = np.maximum(sides, move.pulled)
        ways = (ALONG, np.array(move.point), np.array(move.across))
        closing = ClosingChain(sides, *ways, gap, turned=not move.pulled)
        off = began - began[-1] - closing.pose(0.0)
        cheeks, dips = _cheeks(move, sculpture, began), _dips(move, sculpture, began)
        self._chain = Chain(np.array(corners), began, closing, off, carried, cheeks, dips)

    def advance(self, share: float) -> None:
        """Close the chain by a share."""
        self._hands.bring(self._chain.pose(smooth(share)))


def _dips(move: moves.Gather, sculpture: Sculpture, began: Floats) -> Floats:
    """Return how far what hangs on each corner goes besides, (N, 3), m: hands bend the bubble before an ear
    away from it.
    """
    dips = np.zeros_like(began)
    rings, ring = sculpture.plan.table.rings, move.corners[0]
    before = [r for r in range(ring) if rings[r].joint and rings[r].balloon == rings[ring].balloon]
    if move.pulled and before:
        far = sculpture.frame.middle[sculpture.joints[before[-1]]]
        length = float(np.linalg.norm(began[0] - far))
        dips[0] = length * ((1.0 - math.cos(BENT)) * ALONG - math.sin(BENT) * np.array(move.point))
    return dips


def _cheeks(move: moves.Gather, sculpture: Sculpture, began: Floats) -> Cheeks:
    """Return the rings inside the bubbles of a chain; `began`: where its corners are, (N, 3), m."""
    pairs = [(sculpture.joints[ring], side) for ring, side in move.cheeks]
    joints, sides = np.array(pairs, dtype=np.int64).reshape(-1, 2).T
    straight = sculpture.frame.middle[joints].astype(np.float64) - 0.5 * (began[sides] + began[sides + 1])
    bulge = np.array([sculpture.strip_of(ring).inflated_radius for ring, _ in move.cheeks])[:, None]
    return Cheeks(joints, sides, straight, bulge)
