"""Closing the neck at a ring of latex between two fingers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.solver.latex.motions.ball import squeezed_ball
from balloon_usd.solver.latex.motions.steady import steady
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class Pinch(Motion):
    """Fingers that close a neck."""

    def __init__(self, move: moves.Pinch, sculpture: LatexSculpture) -> None:
        """Take the ring between the fingers, and steady what is before it."""
        self._hands, self._joint = sculpture.hands, sculpture.joints[move.ring]
        self._wide = sculpture.ring_width(self._joint)
        self._neck = float(self._hands.neck[self._joint])
        sculpture.torsion.pinch(move.ring, self._wide)
        self._hands.clasp(self._joint, sculpture.frame.middle)
        self._hands.split_gas(self._joint)
        self._hands.radius[self._joint] = self._wide
        steady(sculpture, move.ring)
        self._ball = squeezed_ball(sculpture, move.ring)
        # All gas of a short bubble would leave through an open neck: what has to leave is pushed out.
        self._open = 1.0 if self._ball is None else 0.0
        self._hands.passage[self._joint] = self._open * math.pi * self._wide**2

    def advance(self, share: float) -> None:
        """Close the neck by a share."""
        radius = self._neck + (self._wide - self._neck) * (1.0 - smooth(share))
        self._hands.squeeze(self._joint, radius, self._open * math.pi * (radius**2 - self._neck**2))
        if self._ball is not None:
            self._ball.squeeze(share)
