"""Bringing flat balloons along in the balloon in which they lie."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class BringInside(Motion):
    """Flat tubes that hands push along through the wall about them, displaced as they are: pushed by their
    knots they telescope.
    """

    def __init__(self, move: moves.BringInside, sculpture: LatexSculpture) -> None:
        """Find what lies in the balloon."""
        self._sculpture, self._gone = sculpture, 0.0
        self._ways = [(vertices, host.way) for vertices, host in sculpture.contents(move.balloon)]

    def advance(self, share: float) -> None:
        """Bring each a share of its way in the coming frame."""
        begin, end, _ = self._sculpture.frame
        rate = (smooth(share) - self._gone) / (end - begin)
        self._gone = smooth(share)
        forward = np.array([1.0, 0.0, 0.0])
        for vertices, way in self._ways:
            self._sculpture.hands.spins.shift(vertices, rate * way * forward)
