"""Rotations as vectors along their axes, as long as their angles."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

NO_ANGLE = 1e-9
"""Angle below which nothing is taken to turn, rad."""


def rotation(vector: Floats) -> Floats:
    """Return the matrix of a rotation vector, (3,), rad (Rodrigues)."""
    angle = float(np.linalg.norm(vector))
    k = cross(vector / max(angle, NO_ANGLE))
    return np.asarray(np.eye(3) + math.sin(angle) * k + (1.0 - math.cos(angle)) * k @ k)


def rotation_vector(matrix: Floats) -> Floats:
    """Return the vector of a rotation by less than half a turn, (3,), rad."""
    twice = np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]])
    sine = 0.5 * float(np.linalg.norm(twice))
    angle = math.atan2(sine, 0.5 * (float(np.trace(matrix)) - 1.0))
    return np.asarray(twice * (angle / (2.0 * max(sine, NO_ANGLE))))


def rotation_onto(others: Floats, places: Floats) -> Floats:
    """Return the rotation, (3, 3), that lays places nearest to others, both about their middle (Kabsch 1976).

    `others`: weighted, where some count more; both (N, 3), m.
    """
    u, _, v = np.linalg.svd(others.T @ places)
    u[:, -1] *= np.sign(np.linalg.det(u @ v))
    return np.asarray(u @ v)


def cross(v: Floats) -> Floats:
    """Return the matrix of the cross product with a vector, (3, 3)."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
