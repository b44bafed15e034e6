"""A finished figure of latex that falls, lands and comes to rest."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.falling import FallingFigure
from balloon_usd.solver.latex.weight import rigid_figure
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.placement import Placement

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class Fall(Motion):
    """A figure that falls from where hands have put it, by the placement of its frames."""

    def __init__(self, move: moves.Fall, sculpture: LatexSculpture) -> None:
        """Let it go."""
        self._sculpture = sculpture
        start = sculpture.placement or Placement.by(np.eye(3), np.zeros(3))
        self._start = start.turn.astype(float), start.shift.astype(float)
        points = sculpture.walls() @ self._start[0].T + self._start[1]
        friction = sculpture.plan.recipe.physics.friction
        figure = rigid_figure(sculpture, points)
        velocity, spin = np.array(move.velocity), np.array(move.spin)
        self._falling = FallingFigure(figure, move.gravity, friction, velocity, spin, ground=move.ground)
        self._until = move.start
        """Time to which it has fallen, s."""

    def advance(self, _: float) -> None:
        """Let it fall to the end of the coming frame: nothing comes after it."""
        end = self._sculpture.frame.end
        self._falling.advance(end - self._until)
        self._until = end
        self._sculpture.placement = Placement.by(*self._falling.moved(*self._start))
