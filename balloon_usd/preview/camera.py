"""Cameras and lights for the views of the preview."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin, tan
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from balloon_usd.stage.shot_camera import held_by

if TYPE_CHECKING:
    import numpy.typing as npt

    from balloon_usd.preview.subdivide import Points

View = Literal["side", "three-quarter", "front-quarter", "front", "top"]
VIEWS: tuple[View, ...] = get_args(View)

FIELD_OF_VIEW = radians(16.0)
"""Vertical opening of the lens: long, so that near bubbles do not look swollen."""
MARGIN = 1.16
"""Room around the sculpture, as a factor of its size in the picture."""
SMALLEST = 0.01
"""Size (m) below which a sculpture is no longer enlarged."""

_DIRECTIONS: dict[View, tuple[float, float]] = {
    "side": (0.0, radians(8.0)),
    "three-quarter": (radians(-32.0), radians(20.0)),
    "front": (radians(-90.0), radians(8.0)),
    "front-quarter": (radians(-62.0), radians(16.0)),
    "top": (0.0, radians(89.9)),
}
"""Turn of the camera round the vertical from looking along +y, and its height above the horizon."""


@dataclass(frozen=True)
class Axes:
    """Orthonormal axes of a camera, world space, z up."""

    right: npt.NDArray[np.float64]
    up: npt.NDArray[np.float64]
    forward: npt.NDArray[np.float64]

    @classmethod
    def of(cls, view: View) -> Axes:
        """Return the axes of a named view."""
        turn, rise = _DIRECTIONS[view]
        forward = np.array([-sin(turn) * cos(rise), cos(turn) * cos(rise), -sin(rise)])
        right = np.array([cos(turn), sin(turn), 0.0])
        return cls(right, np.cross(right, forward), forward)


@dataclass(frozen=True)
class Framing:
    """Where a camera stands so that all points fill its picture."""

    eye: npt.NDArray[np.float64]
    half_width: float
    """Tangent of half the horizontal field of view."""
    half_height: float
    distance: float
    """From the eye to the plane through the middle of the points (m)."""


def frame_points(points: Points, axes: Axes, aspect: float) -> Framing:
    """Return the closest stand from which the points (V, 3) fit, at a fixed lens.

    Args:
        points: what must be seen (m).
        axes: of the camera.
        aspect: width over height of the picture.
    """
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    local = (points - middle) @ np.stack([axes.right, axes.up, axes.forward], axis=1)
    half_height = tan(FIELD_OF_VIEW / 2.0)
    half_width = half_height * aspect
    across, wide = held_by(local[:, 0], local[:, 2], half_width / MARGIN)
    height, tall = held_by(local[:, 1], local[:, 2], half_height / MARGIN)
    distance = max(wide, tall, SMALLEST / half_height)
    eye = middle + across * axes.right + height * axes.up - distance * axes.forward
    return Framing(eye, half_width, half_height, distance)
