"""Where a finished figure is put: a rigid motion of all that its frames show."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from balloon_usd.operations.moves import FRONTS

if TYPE_CHECKING:
    from balloon_usd.operations.moves import Front

Floats = NDArray[np.float64]


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

    def put(self, points: NDArray[np.float32]) -> None:
        """Move points (N, 3) in place, m."""
        points[:] = points @ self.turn.T + self.shift


def turn_of_sides(front: Front, top: Front | None) -> Floats:
    """Return the turn (3, 3) that brings the front of a figure to -x, and its top up: the smallest if none is
    said.
    """
    ahead = np.array(FRONTS[front])
    if top is None:
        return turn_about(*turn_between(ahead, np.array(FRONTS["forward"])))
    up = np.array(FRONTS[top])
    return np.stack([-ahead, np.cross(up, -ahead), up])


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
