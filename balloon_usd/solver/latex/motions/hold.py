"""Putting a finished sculpture of latex down, and waiting until it is at rest."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.solver.motions.motion import Motion

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

PUT_DOWN_SECONDS = 0.25
"""Time in which the drag on a sculpture that is put down grows by a factor e, s: in 0.4 s it damps a
swing of 2 Hz critically.
"""
MOST_DRAG = 400.0
"""Drag on what has been put down, 1/s: at 2 mm/s it takes 2 N from each kg of the mesh, 10 Pa off a wall."""
AT_REST_SECONDS = 1.0
"""Time after which walls keep touching what they touch, s: dry friction at rest does not creep."""


class Hold(Motion):
    """A sculpture that hands put down: what it lies on takes its swing, as the air alone would in minutes.

    Not under gravity: then it falls, as nothing is below it.
    """

    def __init__(self, _: moves.Hold, sculpture: LatexSculpture) -> None:
        """Begin to put it down."""
        self._sculpture = sculpture
        self._bodies = list(sculpture.bodies)
        self._falls = sculpture.scene.settings.gravity > 0.0
        self._lain = 0.0
        """Time since nothing came undone any more, s."""

    def advance(self, _: float) -> None:
        """Put it down further, unless it is still coming undone."""
        sculpture = self._sculpture
        if self._falls or sculpture.unwinding is not None:
            return
        self._lain += sculpture.frame.end - sculpture.frame.begin
        usual = sculpture.scene.settings.drag
        drag = min(usual * math.exp(self._lain / PUT_DOWN_SECONDS), MOST_DRAG)
        sculpture.hands.drag[self._bodies] = drag
        if self._lain >= AT_REST_SECONDS:
            sculpture.hands.lay(self._bodies)
