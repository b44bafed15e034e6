"""Putting a finished sculpture of latex down, and looking at it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

PUT_DOWN_SECONDS = 0.25
"""Time in which the drag on a sculpture that is put down grows by a factor e, s: after 0.4 s it damps a swing
of 2 Hz critically.
"""
MOST_DRAG = 400.0
"""Drag on what has been put down, 1/s: at 2 mm/s it takes 0.8 N from each kg of the mesh, 5 Pa off a wall."""
LIES_AFTER = 0.5
"""Time after which a sculpture lies and sticks to what it lies on, s."""


class Hold(Motion):
    """A sculpture that hands put down: what it lies on takes its swing, and then keeps it from creeping.

    What leaks shrinks, and so does not stick.
    """

    def __init__(self, _: moves.Hold, sculpture: LatexSculpture) -> None:
        """Begin to put it down."""
        self._sculpture = sculpture
        physics = sculpture.plan.recipe.physics
        self._bodies = list(sculpture.bodies)
        self._leaks = physics.leak is not None
        self._drag = float(sculpture.hands.drag[self._bodies[0]])
        self._seconds = 0.0
        """Time since nothing comes undone any more."""

    def advance(self, _: float) -> None:
        """Put it down further, unless it is coming undone."""
        sculpture = self._sculpture
        if sculpture.unwinding:
            return
        self._seconds += sculpture.frame.end - sculpture.frame.begin
        growing = self._drag * math.exp(self._seconds / PUT_DOWN_SECONDS)
        sculpture.hands.drag[self._bodies] = min(growing, MOST_DRAG)
        if self._seconds >= LIES_AFTER and not self._leaks:
            sculpture.hands.lay(self._bodies)
