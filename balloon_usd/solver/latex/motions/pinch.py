"""Closing the neck at a ring of latex between two fingers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.solver.latex.motions.ball import amount_of, squeezed_ball
from balloon_usd.solver.latex.motions.carry_inside import CarryInside
from balloon_usd.solver.latex.motions.steady import steady
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

LEAST_KEPT = 0.9
"""Gas at which fingers shut a bubble's neck early, in what the bubble is to keep: what lies beside it would
press out the rest, and did so to bubbles of 3 cm at a joint of five.
"""
SHUT = 0.7
"""Share of a pinch after which fingers shut the neck to gas in any case, and press out or in what the bubble
then has too much or too little, all of it: what is left of 1 % in each of five bubbles of 19 cm takes three
quarters of the gas of a last one of 3 cm.
"""


class Pinch(Motion):
    """Fingers that close a neck."""

    def __init__(self, move: moves.Pinch, sculpture: LatexSculpture) -> None:
        """Take the ring between the fingers, and steady what is before it."""
        self._sculpture, self._hands = sculpture, sculpture.hands
        self._joint = sculpture.joints[move.ring]
        self._body = sculpture.body[sculpture.balloons[move.ring]]
        # Else what is left gets softer with each twist, which fills 0.5 mm less of its tail, of 9.2.
        self._hands.keep_from_softening(self._body)
        self._wide = sculpture.ring_width(self._joint)
        self._neck = float(self._hands.neck[self._joint])
        sculpture.torsion.pinch(move.ring, self._wide)
        self._hands.clasp(self._joint, sculpture.frame.middle)
        self._hands.split_gas(self._joint)
        self._hands.radius[self._joint] = self._wide
        steady(sculpture, move.ring)
        self._ball = squeezed_ball(sculpture, move.ring)
        self._inside = CarryInside(sculpture, sculpture.balloons[move.ring])
        # All gas of a short bubble would leave through an open neck: what has to leave is pushed out.
        self._open = 1.0 if self._ball is None else 0.0
        self._hands.passage[self._joint] = self._open * math.pi * self._wide**2
        strip, name = sculpture.strip_of(move.ring), sculpture.plan.table.rings[move.ring].bubble
        bubble = next(b for b in strip.bubbles if b.name == name)
        self._wanted, self._shared = amount_of(sculpture, bubble), 0.0

    def advance(self, share: float) -> None:
        """Close the neck by a share, at once to gas that has to stay; once it is shut, press gas through it
        until the bubble has what it is to keep.
        """
        self._inside.advance()
        if self._ball is None:
            self._press_gas(share)
        closed = smooth(share)
        radius = self._neck + (self._wide - self._neck) * (1.0 - closed)
        passage = self._open * math.pi * (radius**2 - self._neck**2)
        self._hands.squeeze(self._joint, radius, passage)
        self._hands.hide_rubber(self._joint, closed)
        if self._ball is not None:
            self._ball.squeeze(share)
        if share >= 1.0:
            self._hands.let_soften(self._body)

    def _press_gas(self, share: float) -> None:
        over = self._hands.amount_before(self._joint) - self._wanted
        if share > SHUT or over < (LEAST_KEPT - 1.0) * self._wanted:
            self._open = 0.0
            self._hands.passage[self._joint] = 0.0
        if self._open == 0.0:
            begin, end, _ = self._sculpture.frame
            now = (share - self._shared) / (1.0 - self._shared)
            self._hands.push_gas(self._joint, now * over / (end - begin))
        self._shared = share
