"""Where a camera stands so that a box fills its picture."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

TURN, RISE = radians(-32.0), radians(16.0)
"""Turn round the vertical from looking along +y, and height above the horizon: three quarters, from above."""

FOCAL_LENGTH, SENSOR_WIDTH, ASPECT = 0.085, 0.036, 16.0 / 9.0
"""Lens and sensor [m]: long, so that near bubbles do not look swollen."""

ROOM = 1.12
"""Picture around the sculpture, as a factor of its size."""


@dataclass(frozen=True)
class Viewpoint:
    """A place and the directions of a picture, world space, z up."""

    eye: NDArray[np.float64]
    """(3,) [m]."""
    right: NDArray[np.float64]
    up: NDArray[np.float64]
    forward: NDArray[np.float64]

    @property
    def ahead(self) -> NDArray[np.float64]:
        """Unit level direction (3,) in which the camera looks."""
        return np.cross(np.array([0.0, 0.0, 1.0]), self.right)


def frame_box(extent: NDArray[np.float32]) -> Viewpoint:
    """The closest stand from which a box, given by its two corners (2, 3) [m], fits into the picture."""
    forward = np.array([-sin(TURN) * cos(RISE), cos(TURN) * cos(RISE), -sin(RISE)])
    right = np.array([cos(TURN), sin(TURN), 0.0])
    up = np.cross(right, forward)
    low, high = extent.astype(np.float64)
    corners = np.array(
        [[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    )
    middle = corners.mean(axis=0)
    local = (corners - middle) @ np.stack([right, up, forward], axis=1)
    slope = SENSOR_WIDTH / FOCAL_LENGTH / 2.0 / ROOM
    fits = [held_by(local[:, 0], local[:, 2], slope), held_by(local[:, 1], local[:, 2], slope / ASPECT)]
    across, height = (offset for offset, _ in fits)
    distance = max(distance for _, distance in fits)
    return Viewpoint(middle + across * right + height * up - distance * forward, right, up, forward)


def held_by(offset: NDArray[np.float64], depth: NDArray[np.float64], slope: float) -> tuple[float, float]:
    """Return the offset and the distance of the eye (m) at which a wedge of a slope just holds all points."""
    high = float(np.max(offset - slope * depth))
    low = float(np.min(offset + slope * depth))
    return 0.5 * (high + low), 0.5 * (high - low) / slope
