"""Solid angles under which places see a ring."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

WHOLE = 4.0 * math.pi
"""Solid angle round a point, sr: by so much that of a ring changes for a point that goes all through it."""


def solid_angles(places: Floats, ring: Floats) -> Floats:
    """Return the solid angles (sr), signed by the side, under which places, (P, 3) m, see a ring through
    others, (N, 3) m: of the triangles from its centre (Van Oosterom & Strackee 1983).
    """
    a = (ring.mean(axis=0) - places)[:, None]
    b = ring - places[:, None]
    c = np.roll(b, -1, axis=1)
    la, lb, lc = (np.linalg.norm(each, axis=2) for each in (a, b, c))
    volume = (np.cross(b, c) * a).sum(axis=2)
    rest = la * lb * lc + (b * a).sum(axis=2) * lc + (b * c).sum(axis=2) * la + (c * a).sum(axis=2) * lb
    found: Floats = 2.0 * np.arctan2(volume, rest).sum(axis=1)
    return found
