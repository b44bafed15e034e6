"""A finished figure of latex that falls, lands and comes to rest."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.falling import FallingFigure
from balloon_usd.solver.latex.weight import rigid_figure
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.placement import Placed, Placement

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

    Floats = NDArray[np.float64]

DEEP = 2.0e-4
"""Depth in the ground from which on hands lift what has crept into it since they set it down, m: what weighs
a gram would leap from there.
"""
SUNK = 5.0e-4
"""Depth in the ground from which on a figure that lies is lifted out, m: its rubber creeps on while it falls
as a rigid body, by some millimetres in five seconds; a rigid body lies 0.3 mm deep at most.
"""


class Fall(Motion):
    """A figure that falls from where hands have put it, by the placement of its frames; if it has come apart,
    each part by itself.
    """

    def __init__(self, move: moves.Fall, sculpture: LatexSculpture) -> None:
        """Let it go."""
        self._sculpture, self._ground = sculpture, move.ground
        self._parts, walls = sculpture.parts, sculpture.walls()
        still = (Placement.by(np.eye(3), np.zeros(3)),) * len(self._parts)
        starts = sculpture.placed.placements if sculpture.placed else still
        self._starts = [(start.turn.astype(float), start.shift.astype(float)) for start in starts]
        points = np.empty_like(walls)
        for part, (turn, shift) in zip(self._parts, self._starts, strict=True):
            points[part] = walls[part] @ turn.T + shift
            lowest = float(points[part][:, 2].min())
            if move.ground and lowest < -DEEP:
                points[part, 2] -= lowest
                shift[2] -= lowest
        self._falling = list(_let_go(move, sculpture, points))
        self._until = move.start
        """Time to which it has fallen, s."""

    def advance(self, _: float) -> None:
        """Let it fall to the end of the coming frame: nothing comes after it."""
        end = self._sculpture.frame.end
        for falling in self._falling:
            falling.advance(end - self._until)
        self._until = end
        self._sculpture.placed = Placed(self._parts, tuple(self._placements()))

    def _placements(self) -> Iterator[Placement]:
        """Yield where every part is by now, no deeper in the ground than it may be."""
        walls = self._sculpture.walls()
        for part, falling, start in zip(self._parts, self._falling, self._starts, strict=True):
            turn, shift = falling.moved(*start)
            if self._ground:
                lowest = float((walls[part] @ turn[2]).min()) + float(shift[2])
                shift = shift + np.array([0.0, 0.0, max(-SUNK - lowest, 0.0)])
            yield Placement.by(turn, shift)


def _let_go(move: moves.Fall, sculpture: LatexSculpture, points: Floats) -> Iterator[FallingFigure]:
    """Yield every part of a sculpture, let go with its share of the figure's spin; `points`: (V, 3), m."""
    whole = rigid_figure(sculpture, points)
    friction, spin = sculpture.plan.recipe.physics.friction, np.array(move.spin)
    several = len(sculpture.parts) > 1
    for part in sculpture.parts:
        figure = rigid_figure(sculpture, points, part) if several else whole
        velocity = np.array(move.velocity) + np.cross(spin, figure.centre - whole.centre)
        yield FallingFigure(figure, move.gravity, friction, velocity, spin, ground=move.ground)
