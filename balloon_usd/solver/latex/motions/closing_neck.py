"""Fingers that close the neck at a ring of latex, and see to it how much gas stays before it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth

if TYPE_CHECKING:
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


class ClosingNeck(Motion):
    """Fingers that close a neck."""

    def __init__(self, ring: int, sculpture: LatexSculpture) -> None:
        """Take a ring of the plan between the fingers."""
        self._sculpture, self._hands = sculpture, sculpture.hands
        self._joint = sculpture.joints[ring]
        self._body = sculpture.body[sculpture.balloons[ring]]
        # Else what is left gets softer with each twist, which fills 0.5 mm less of its tail, of 9.2.
        self._hands.keep_from_softening(self._body)
        self._wide = sculpture.ring_width(self._joint)
        self._neck = float(self._hands.neck[self._joint])
        sculpture.torsion.pinch(ring, self._wide)
        self._hands.clasp(self._joint, sculpture.frame.middle)
        self._hands.split_gas(self._joint)
        self._hands.radius[self._joint] = self._wide
        self._wanted: float | None = None
        self._open, self._shared = 1.0, 0.0
        self._hands.passage[self._joint] = math.pi * self._wide**2

    def keep(self, amount: float) -> None:
        """Press gas through the neck until so much (mol) stays before it."""
        self._wanted = amount

    def shut(self) -> None:
        """Let no gas through from the start."""
        self._open = 0.0
        self._hands.passage[self._joint] = 0.0

    def advance(self, share: float) -> None:
        """Close the neck by a share, at once to gas that has to stay; once it is shut, press gas through it
        until there is before it what it is to keep.
        """
        if self._wanted is not None:
            self._press_gas(share, self._wanted)
        closed = smooth(share)
        radius = self._neck + (self._wide - self._neck) * (1.0 - closed)
        passage = self._open * math.pi * (radius**2 - self._neck**2)
        self._hands.squeeze(self._joint, radius, passage)
        self._hands.hide_rubber(self._joint, closed)
        if share >= 1.0:
            self._hands.let_soften(self._body)

    def _press_gas(self, share: float, wanted: float) -> None:
        over = self._hands.amount_before(self._joint) - wanted
        if share > SHUT or over < (LEAST_KEPT - 1.0) * wanted:
            self.shut()
        if self._open == 0.0:
            begin, end, _ = self._sculpture.frame
            now = (share - self._shared) / (1.0 - self._shared)
            self._hands.push_gas(self._joint, now * over / (end - begin))
        self._shared = share
