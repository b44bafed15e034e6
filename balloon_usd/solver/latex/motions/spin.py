"""Turning what lies beyond a closed ring about the axis of the ring's balloon."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.latex.motions.beyond import beyond_on_its_balloon, beyond_on_others
from balloon_usd.solver.latex.motions.steady import steady
from balloon_usd.solver.latex.spins import VertexSet
from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class Spin(Motion):
    """A balloon that is turned beyond a ring with all that hangs on it there, which winds the ring's neck."""

    def __init__(self, move: moves.Spin, sculpture: LatexSculpture) -> None:
        """Steady what is before the ring."""
        self._sculpture, self._move = sculpture, move
        self._joint = sculpture.joints[move.ring]
        own = beyond_on_its_balloon(sculpture, move.ring)
        self._own = VertexSet.of(own)
        """What lies beyond on the ring's balloon, whose axis is the axis of the turn."""
        self._turning = VertexSet.of(np.concatenate([own, beyond_on_others(sculpture, move.ring)]))
        steady(sculpture, move.ring)

    def advance(self, _: float) -> None:
        """Turn through the part of the frame that lies in the time of the move."""
        move, (begin, end, middle) = self._move, self._sculpture.frame
        inside = max(0.0, min(end, move.end) - max(begin, move.start))
        self._sculpture.torsion.wind(move.ring, move.turns * inside / move.seconds)
        rate = 2.0 * math.pi * move.turns / move.seconds * inside / (end - begin)
        self._sculpture.hands.turn(self._turning, middle[self._joint], self._own, rate)
