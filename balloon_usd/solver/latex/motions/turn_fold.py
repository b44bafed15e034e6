"""Turning a fold about its joint: the gesture of a lock twist."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations.tempo import eased
from balloon_usd.solver.latex.motions.beyond import vertices_at
from balloon_usd.solver.latex.spins import VertexSet
from balloon_usd.solver.motions.hanging import folded_between
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.placement import turn_about, unit

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]


class TurnFold(Motion):
    """Bubbles folded between two joints, which hands turn about the joint that these have become.

    The other hand holds all that does not turn. Where the fold hangs together with the rest elsewhere, as in
    a closed net, nothing can turn.
    """

    def __init__(self, move: moves.TurnFold, sculpture: LatexSculpture) -> None:
        """Take the fold, and hold the rest."""
        self._move, self._sculpture, self._hands = move, sculpture, sculpture.hands
        self._share = 0.0
        """Share of its turns that are done."""
        rings = folded_between(*move.rings, sculpture.balloons, sculpture.welds)
        self._turning = VertexSet.of(vertices_at(sculpture, rings)) if rings else None
        if self._turning is None:
            return
        middle, joints = sculpture.frame.middle, sculpture.joints
        hands, fold = self._hands, {joints[ring] for ring in rings}
        bases = [joints[ring] for ring in move.rings]
        for joint in bases:
            # Clasped rings, which do not turn with the walls, leave folds twice as deep in the necks.
            hands.grip(joint, middle)
            hands.unclasp(joint)
        for joint in set(joints) - fold - set(bases):
            hands.lead(joint, middle)
        self._point: Floats = middle[bases].mean(axis=0, dtype=np.float64)
        self._axis = unit(hands.places[self._turning.indices].mean(axis=0, dtype=np.float64) - self._point)
        self._led = np.array([joint for joint in sorted(fold) if hands.leads(joint)], dtype=np.int64)
        self._began: Floats = hands.goal[self._led] - self._point

    def advance(self, share: float) -> None:
        """Turn as far as the time of the move that is over then asks, with ease in and out."""
        if self._turning is None:
            return
        turns = self._move.turns * (eased(share) - self._share)
        self._share = eased(share)
        begin, end, _ = self._sculpture.frame
        rate = 2.0 * math.pi * turns / (end - begin)
        self._hands.spin(self._turning, self._point, self._axis, rate)
        angle = 2.0 * math.pi * self._move.turns * self._share
        self._hands.goal[self._led] = self._point + self._began @ turn_about(self._axis, angle).T
