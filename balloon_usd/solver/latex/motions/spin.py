"""Turning what lies beyond a closed ring about the axis of the ring's balloon."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.operations.tempo import eased
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
        self._turned = 0.0
        """Share of its turns that are done."""
        own = beyond_on_its_balloon(sculpture, move.ring)
        self._own = VertexSet.of(own)
        """What lies beyond on the ring's balloon, whose axis is the axis of the turn."""
        self._turning = VertexSet.of(np.concatenate([own, beyond_on_others(sculpture, move.ring)]))
        steady(sculpture, move.ring)

    def advance(self, share: float) -> None:
        """Turn as far as the time of the move that is over then asks, with ease in and out."""
        turns = self._move.turns * (eased(share) - self._turned)
        self._turned = eased(share)
        self._sculpture.torsion.wind(self._move.ring, turns)
        begin, end, middle = self._sculpture.frame
        rate = 2.0 * math.pi * turns / (end - begin)
        self._sculpture.hands.turn(self._turning, middle[self._joint], self._own, rate)
