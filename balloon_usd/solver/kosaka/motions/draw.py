"""Drawing a ring of a net together, until it freezes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.kosaka.sculpture import KosakaSculpture

CLOSED_EARLY = 0.75
"""Share of a pinch's time in which the ring closes; in the rest it comes to coincide."""


class Draw(Motion):
    """A ring that is drawn together by force."""

    def __init__(self, move: moves.Pinch, sculpture: KosakaSculpture) -> None:
        """Take hold of the ring."""
        self._hands, self._joint = sculpture.hands, sculpture.joints[move.ring]
        self._wide = sculpture.ring_width(self._joint)
        self._neck = float(self._hands.neck[self._joint])
        self._hands.clasp(self._joint, sculpture.frame.middle)
        self._hands.touch(sculpture.bodies)
        self._hands.radius[self._joint] = self._wide

    def advance(self, share: float) -> None:
        """Draw it together by a share."""
        closed = smooth(share / CLOSED_EARLY)
        self._hands.close(self._joint, self._neck + (self._wide - self._neck) * (1.0 - closed))
