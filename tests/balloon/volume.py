"""The volume that a closed mesh holds."""

from __future__ import annotations

import numpy as np


def volume_of(points, quads):
    """Signed volume of a closed surface, m3: positive where its faces are counter-clockwise from outside."""
    corners = points[quads].astype(float)
    area = 0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    return np.sum(corners.mean(axis=1) * area) / 3.0
