"""Putting a finished figure of latex where it stays; on the ground it settles under its weight."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.falling import FallingFigure
from balloon_usd.solver.latex.weight import rigid_figure
from balloon_usd.solver.motions.set_down import SetDown

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]


class LatexSetDown(SetDown):
    """Hands that carry a whole figure of latex."""

    _sculpture: LatexSculpture

    def _end(self, move: moves.SetDown, points: Floats) -> tuple[Floats, Floats]:
        """Let it settle on the ground: before that, only the points are known on which it will stand."""
        turn, shift = super()._end(move, points)
        if move.pose != "stand" or move.gravity == 0.0:
            return turn, shift
        figure = rigid_figure(self._sculpture, points @ turn.T + shift)
        friction = self._sculpture.plan.recipe.physics.friction
        fall = FallingFigure(figure, move.gravity, friction, ground=True)
        fall.settle()
        turn, shift = fall.moved(turn, shift)
        stands = points @ turn.T + shift
        shift[:2] -= 0.5 * (stands.min(axis=0) + stands.max(axis=0))[:2]
        return turn, shift
