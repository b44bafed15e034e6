"""Putting a finished figure where it stays: on the ground, on a thread, or held where it is."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations.moves import LET_GO
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth
from balloon_usd.solver.placement import (
    Placed,
    Placement,
    axis_and_angle,
    turn_about,
    turn_between,
    turn_facing,
    unit,
)
from balloon_usd.solver.resting import standing_direction
from balloon_usd.solver.sculpture import ALL

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.sculpture import Sculpture

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

DOWN = np.array([0.0, 0.0, -1.0])
LOOKS = 13
"""Angles between the first and the last of a turn at which the room that it takes is looked at."""
ALIKE = 5.0e-3
"""Difference of the cosines of angles to the vertical that is none: of a tube that lies, rounding would tell
by which end it hangs.
"""


class Way(NamedTuple):
    """How hands carry something: they turn it about its centre, and that goes straight on."""

    centre: Floats
    """(3,), m."""
    axis: Floats
    """Unit vector, (3,)."""
    angle: float
    """rad"""
    forward: Floats
    """Way of the centre, (3,), m."""
    apart: bool = False
    """Whether it is brought aside first, and turned and lowered then."""

    @classmethod
    def to(cls, centre: Floats, turn: Floats, shift: Floats) -> Self:
        """Return the way to a turn (3, 3) about the origin and a shift (3,) behind it, m."""
        return cls(centre, *axis_and_angle(turn), turn @ centre + shift - centre)

    @property
    def turn(self) -> Floats:
        """The turn of the whole way, (3, 3)."""
        return turn_about(self.axis, self.angle)

    def placement(self, share: float) -> Placement:
        """Return where it is after a share of the time."""
        aside = turning = smooth(share)
        if self.apart:
            aside, turning = smooth(min(2.0 * share, 1.0)), smooth(max(2.0 * share - 1.0, 0.0))
        turn = turn_about(self.axis, turning * self.angle)
        gone = np.array([aside, aside, turning]) * self.forward
        return Placement.by(turn, self.centre + gone - turn @ self.centre)

    def after(self, aside: Floats) -> Self:
        """Return the same way for what is brought aside before, (3,), m."""
        return self._replace(forward=self.forward + aside, apart=True)

    def room(self, points: Floats) -> Floats:
        """Return two corners of a box about all places where points (N, 3), m, are while it is turned, m."""
        middle, arms = self.centre + self.forward, points - self.centre
        turns = (turn_about(self.axis, share * self.angle) for share in np.linspace(0.0, 1.0, LOOKS))
        ends = [edge(arms @ turn.T, axis=0) for turn in turns for edge in (np.min, np.max)]
        return np.stack([middle + np.min(ends, axis=0), middle + np.max(ends, axis=0)])


class SetDown(Motion):
    """Hands that carry the whole figure as it is, by the placement of its frames."""

    def __init__(self, move: moves.SetDown, sculpture: Sculpture) -> None:
        """See how it lies, and find where it goes."""
        self._sculpture = sculpture
        points = sculpture.walls()
        self._centre = sculpture.centre(points)
        self._ways = self._found(move, points)

    def _found(self, move: moves.SetDown, points: Floats) -> list[Way]:
        """Return the way of every part: all go together; `points`: its vertices, (V, 3), m."""
        facing = facing_turn(move, self._sculpture, points)
        return [Way.to(self._centre, *self._end(move, points, facing))] * len(self._sculpture.parts)

    def _end(
        self, move: moves.SetDown, points: Floats, facing: Floats, part: Ints | slice = ALL
    ) -> tuple[Floats, Floats]:
        """Return the turn (3, 3) about the origin and the shift (3,) behind it, m, after which a part stays.

        `points`: all vertices, (V, 3), m; `facing`: the turn (3, 3) that brings front and top where they go.
        """
        centre = self._sculpture.centre(points, part)
        arms = (points[part] - centre) @ facing.T
        thread = _thread(arms, facing, centre, self._sculpture, part)
        down = DOWN
        if move.pose == "stand":
            down = standing_direction(arms, np.zeros(3), DOWN)
        elif move.pose == "hang":
            down = unit(-thread)
        tipping = turn_about(*turn_between(down, DOWN))
        turn = tipping @ facing
        if move.pose == "as made":
            return turn, centre - turn @ centre
        pivot = _pivot(move.pose, arms @ tipping.T, tipping @ thread)
        return turn, np.array([0.0, 0.0, move.height]) - pivot - turn @ centre

    @property
    def turn(self) -> Floats:
        """The turn of the whole way, (3, 3), of the first part."""
        return self._ways[0].turn

    def advance(self, share: float) -> None:
        """Carry it a share of the way."""
        placements = tuple([way.placement(share) for way in self._ways])
        self._sculpture.placed = Placed(self._sculpture.parts, placements)


def facing_turn(move: moves.SetDown | moves.Level, sculpture: Sculpture, points: Floats) -> Floats:
    """Return the turn (3, 3) that brings a figure's front and top where they go.

    `points`: its vertices, (V, 3), m.
    """
    return turn_facing(move.front, move.top, points.mean(axis=0), sculpture.bubble_middle)


def _thread(arms: Floats, facing: Floats, centre: Floats, sculpture: Sculpture, part: Ints | slice) -> Floats:
    """Return where a thread is tied, from the centre, (3,), m: where the part stays most upright, of joints
    the first that does so.

    `arms`: its points from its centre, (N, 3), m, turned by `facing`, (3, 3).
    """
    joints = sculpture.frame.middle[sculpture.outer_joints(part)].astype(np.float64)
    arms = (joints - centre) @ facing.T if len(joints) else arms[sculpture.outer_vertices]
    upright = arms[:, 2] / np.maximum(np.linalg.norm(arms, axis=1), 1e-9)
    alike = ALIKE if len(joints) else 0.0
    found: Floats = arms[int(np.argmax(upright >= upright.max() - alike))]
    return found


def _pivot(pose: str, turned: Floats, thread: Floats) -> Floats:
    """Return what of the turned figure comes to the origin, (3,), m.

    `turned`: its points from its centre, (N, 3), m; `thread`: where it is tied, from its centre, (3,), m.
    """
    if pose == "hang":
        return thread
    low, high = turned.min(axis=0), turned.max(axis=0)
    middle: Floats = 0.5 * (low + high)
    if pose in ("stand", *LET_GO):
        middle[2] = low[2]
    return middle
