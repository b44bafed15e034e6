"""Where a finished figure is put: a rigid motion of all that its frames show."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations.moves import FRONTS

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from balloon_usd.operations.moves import Facing

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

FORWARD = np.array(FRONTS["forward"])
UP = np.array(FRONTS["up"])
LEAST_ACROSS = 0.3
"""Sine of the angle below which a front lies along the top: where it faces then says nothing."""


class Placement(NamedTuple):
    """A turn about the origin and a shift behind it."""

    turn: NDArray[np.float32]
    """Rotation matrix, (3, 3)."""
    shift: NDArray[np.float32]
    """(3,), m."""

    @classmethod
    def by(cls, turn: Floats, shift: Floats) -> Self:
        """Return a turn (3, 3) about the origin and a shift (3,) behind it, m."""
        return cls(turn.astype(np.float32), shift.astype(np.float32))

    def moved(self, points: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return points (N, 3), m, where they are put."""
        return points @ self.turn.T + self.shift


class Placed(NamedTuple):
    """Where the parts of a finished figure are put: just one if it has not come apart."""

    parts: tuple[Ints, ...]
    """Vertices of every part, among those of the figure."""
    placements: tuple[Placement, ...]

    def put(self, points: Sequence[NDArray[np.float32]]) -> None:
        """Move the vertices, and the air, of every balloon in place, (N, 3) each, m."""
        if len(self.placements) == 1:
            for each in points:
                each[:] = self.placements[0].moved(each)
            return
        walls = np.concatenate(points)
        for part, placement in zip(self.parts, self.placements, strict=True):
            walls[part] = placement.moved(walls[part])
        ends = np.cumsum([len(each) for each in points])
        for each, moved in zip(points, np.split(walls, ends[:-1]), strict=True):
            each[:] = moved


def turn_facing(front: Facing, top: Facing | None, middle: Floats, of: Callable[[str], Floats]) -> Floats:
    """Return the turn (3, 3) that brings the front of a figure to -x, and its top up: the smallest if none is
    said, or if it is told by bubbles and no front is said beside it.

    Args:
        front: a side, or bubbles that lie there.
        top: the same, or None.
        middle: of the figure, (3,), m.
        of: gives the middle of a bubble by its name, (3,), m.
    """
    up = None if top is None else _direction(top, middle, of)
    if up is not None and not isinstance(top, str) and front == "forward":
        return turn_about(*turn_between(up, UP))
    ahead = _direction(front, middle, of)
    if up is None:
        return turn_about(*turn_between(ahead, FORWARD))
    across = np.cross(up, -ahead)
    if (size := float(np.linalg.norm(across))) < LEAST_ACROSS:
        return turn_about(*turn_between(up, UP))
    across /= size
    return np.stack([np.cross(across, up), across, up])


def _direction(facing: Facing, middle: Floats, of: Callable[[str], Floats]) -> Floats:
    """Return the unit direction (3,) of a side, or that in which bubbles lie from the middle of a figure."""
    if isinstance(facing, str):
        return np.array(FRONTS[facing])
    return unit(np.mean([of(bubble) for bubble in facing], axis=0) - middle)


def unit(vector: Floats) -> Floats:
    """Return a vector (3,) at length 1."""
    found: Floats = vector / max(float(np.linalg.norm(vector)), 1e-9)
    return found


def turn_between(one: Floats, other: Floats) -> tuple[Floats, float]:
    """Return the axis (3,) and the angle (rad) of the smallest turn that takes a unit vector to another."""
    axis = np.cross(one, other)
    size = float(np.linalg.norm(axis))
    if size < 1e-12:
        # Opposite ones are turned about any axis across them.
        axis = np.cross(one, np.eye(3)[int(np.argmin(np.abs(one)))])
        size = float(np.linalg.norm(axis))
        return axis / size, 0.0 if float(one @ other) > 0.0 else float(np.pi)
    return axis / size, float(np.arctan2(size, one @ other))


def axis_and_angle(turn: Floats) -> tuple[Floats, float]:
    """Return the unit axis (3,) and the angle (rad) of a rotation matrix (3, 3), a half turn included."""
    axis: Floats = np.linalg.eigh(turn + turn.T)[1][:, -1]
    skew = 0.5 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    return axis, float(np.arctan2(axis @ skew, 0.5 * (np.trace(turn) - 1.0)))


def turn_about(axis: Floats, angle: float) -> Floats:
    """Return the rotation matrix (3, 3) about a unit axis (3,) by an angle (rad)."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turn: Floats = np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross)
    return turn
