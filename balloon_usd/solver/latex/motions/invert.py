"""Pressing the knot of a balloon through its first bubble, whose wall is turned inside."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]


class Invert(Motion):
    """A knot that a finger leads along the axis of its bubble, until it lies before the neck at its end."""

    def __init__(self, move: moves.Invert, sculpture: LatexSculpture) -> None:
        """Hold the neck, and take the knot; neither turns meanwhile."""
        self._hands = hands = sculpture.hands
        hands.touch(sculpture.bodies)
        middle = sculpture.frame.middle
        self._knot, neck = sculpture.joints[move.knot], sculpture.joints[move.to]
        for joint in (self._knot, neck):
            hands.clasp(joint, middle)
        self._began: Floats = middle[self._knot].astype(np.float64)
        way = middle[neck] - self._began
        far = float(np.linalg.norm(way))
        # As far from the neck as two necks lie that are twisted into one.
        self._way: Floats = way * (1.0 - 2.0 * float(hands.neck[neck]) / far)

    def advance(self, share: float) -> None:
        """Lead the knot a share of its way."""
        self._hands.goal[self._knot] = self._began + smooth(share) * self._way
