"""Where the lamps of the studio stand, as seen from the camera."""

from __future__ import annotations

from math import cos, pi, radians, sin, sqrt, tan
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.stage.lamp import Lamp

if TYPE_CHECKING:
    import numpy.typing as npt

DIRECTIONS = 96
"""Rays that gather light over the whole sphere."""


SOFTBOXES = (
    Lamp("key", radians(-48.0), radians(46.0), radians(20.0), radians(25.0), 13.0),
    Lamp("rim", radians(125.0), radians(25.0), radians(12.0), radians(40.0), 7.0),
    Lamp("top", radians(150.0), radians(74.0), radians(40.0), radians(24.0), 3.0),
)
"""A big key from the upper left, a strip behind on the right for the edge, a bank overhead."""


def softbox_axes(box: Lamp, forward: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return centre, right and up of a lamp as rows (3, 3); right and up are divided by the half openings.

    Args:
        box: the lamp.
        forward: (3,) where the camera looks, which the lamps turn with.
    """
    ahead = level(forward)
    right = np.array([ahead[1], -ahead[0], 0.0])
    towards = -cos(box.azimuth) * ahead + sin(box.azimuth) * right
    centre = cos(box.elevation) * towards + np.array([0.0, 0.0, sin(box.elevation)])
    side = np.array([-towards[1], towards[0], 0.0])
    return np.stack([centre, side / tan(box.width), np.cross(centre, side) / tan(box.height)])


def level(direction: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return the unit horizontal part (3,) of a direction that is not vertical."""
    flat = np.array([direction[0], direction[1], 0.0])
    return np.asarray(flat / np.linalg.norm(flat))


def sphere_directions(count: int) -> npt.NDArray[np.float32]:
    """Return unit vectors (count, 3) spread evenly over the sphere (Fibonacci lattice)."""
    golden = pi * (3.0 - sqrt(5.0))
    height = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    ring = np.sqrt(1.0 - height**2)
    turn = golden * np.arange(count)
    return np.stack([ring * np.cos(turn), ring * np.sin(turn), height], axis=1).astype(np.float32)
