"""Turning the balloon beyond a closed ring about its own axis."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.solver.latex.motions.steady import steady
from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

SPIN_CLEAR = 1e-6
"""What lies farther than this beyond a joint turns with the balloon, m."""


class Spin(Motion):
    """A balloon that is turned beyond a ring, which winds the ring's neck."""

    def __init__(self, move: moves.Spin, sculpture: LatexSculpture) -> None:
        """Steady what is before the ring."""
        self._sculpture, self._move = sculpture, move
        ring = sculpture.plan.table.rings[move.ring]
        self._joint, self._body = sculpture.joints[move.ring], sculpture.body[ring.balloon]
        self._beyond = ring.along + SPIN_CLEAR
        steady(sculpture, move.ring)

    def advance(self, _: float) -> None:
        """Turn through the part of the frame that lies in the time of the move."""
        move, (begin, end, middle) = self._move, self._sculpture.frame
        inside = max(0.0, min(end, move.end) - max(begin, move.start))
        self._sculpture.torsion.wind(move.ring, move.turns * inside / move.seconds)
        rate = 2.0 * math.pi * move.turns / move.seconds * inside / (end - begin)
        self._sculpture.hands.turn(self._body, middle[self._joint], self._beyond, rate)
