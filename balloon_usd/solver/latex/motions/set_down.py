"""Putting a finished figure of latex where it stays; on the ground it settles under its weight."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations.moves import LET_GO
from balloon_usd.solver.falling import FallingFigure
from balloon_usd.solver.latex.weight import rigid_figure
from balloon_usd.solver.motions.set_down import SetDown, Way, facing_turn
from balloon_usd.solver.sculpture import ALL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


GAP = 0.02
"""Least distance at which hands put parts beside each other, m."""
FALLS_OVER = 2.0
"""How far from where its middle was an end of a tube comes to lie that lands on the other one and falls over,
in the distance of the farthest vertex from its middle.
"""
APART = ("stand", "hang", *LET_GO)
"""Poses in which parts that have come apart are put each by itself."""


class LatexSetDown(SetDown):
    """Hands that carry a whole figure of latex, or each of the parts into which it has come apart."""

    _sculpture: LatexSculpture

    def _found(self, move: moves.SetDown, points: Floats) -> list[Way]:
        """Let parts that have come apart stand or hang where they are, or beside each other if they do not
        fit; let go of above the ground they have room to fall over.
        """
        parts, centre = self._sculpture.parts, self._sculpture.centre
        if move.pose not in APART or len(parts) == 1:
            return super()._found(move, points)
        facing = facing_turn(move, self._sculpture, points)
        if move.pose in LET_GO:
            ends = [self._end(move, points, facing)] * len(parts)
        else:
            ends = [self._end(move, points, facing, part) for part in parts]
            for part, (_, shift) in zip(parts, ends, strict=True):
                shift[:2] += (facing @ (centre(points, part) - self._centre))[:2]
        ways = [Way.to(centre(points, part), *end) for part, end in zip(parts, ends, strict=True)]
        rooms = [way.room(points[part]) for way, part in zip(ways, parts, strict=True)]
        if move.pose in LET_GO:
            rooms = [_round_it(room) for room in rooms]
        shifts = beside_each_other(rooms)
        return [way.after(shift) for way, shift in zip(ways, shifts, strict=True)]

    def _end(
        self, move: moves.SetDown, points: Floats, facing: Floats, part: Ints | slice = ALL
    ) -> tuple[Floats, Floats]:
        """Let it settle on the ground: before that, only the points are known on which it will stand."""
        turn, shift = super()._end(move, points, facing, part)
        if move.pose != "stand" or move.gravity == 0.0:
            return turn, shift
        figure = rigid_figure(self._sculpture, points @ turn.T + shift, part)
        friction = self._sculpture.plan.recipe.physics.friction
        fall = FallingFigure(figure, move.gravity, friction, ground=True)
        fall.settle()
        turn, shift = fall.moved(turn, shift)
        stands = points[part] @ turn.T + shift
        shift[:2] -= 0.5 * (stands.min(axis=0) + stands.max(axis=0))[:2]
        return turn, shift


def _round_it(room: Floats) -> Floats:
    """Return two corners of a box about all that may be reached by what is dropped out of one, (2, 3), m."""
    reach = FALLS_OVER * 0.5 * float(np.linalg.norm(room[1] - room[0]))
    middle = room.mean(axis=0)
    return np.stack([middle - reach, middle + reach])


def beside_each_other(parts: Sequence[Floats]) -> list[Floats]:
    """Return the shift of every part, (3,), m, with which none stands above another, all about the origin.

    `parts`: their vertices, or corners of boxes about these, (N, 3) each, m.
    """
    low, high = (np.array([edge(part, axis=0)[:2] for part in parts]) for edge in (np.min, np.max))
    along = int(np.argmax(np.ptp(low + high, axis=0)))
    shift = np.zeros((len(parts), 3))
    if _overlap(low, high):
        order = np.argsort((low + high)[:, along], kind="stable").tolist()
        for before, after in pairwise(order):
            free = high[before, along] + shift[before, along] + GAP
            shift[after, along] = max(free - low[after, along], 0.0)
    low, high = low + shift[:, :2], high + shift[:, :2]
    shift[:, :2] -= 0.5 * (low.min(axis=0) + high.max(axis=0))
    return list(shift)


def _overlap(low: Floats, high: Floats) -> bool:
    """Tell whether any two boxes lie nearer to each other than a gap; `low`, `high`: (N, 2), m."""
    near = ((low[:, None] < high[None] + GAP) & (low[None] < high[:, None] + GAP)).all(axis=2)
    return bool(near.sum() > len(low))
