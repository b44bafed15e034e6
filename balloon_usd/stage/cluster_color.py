"""Colours that tell the clusters of air apart."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

CLUSTER_COLORS = np.array(
    [
        (0.012, 0.105, 0.687),
        (0.010, 0.305, 0.051),
        (0.791, 0.050, 0.309),
        (0.003, 0.361, 0.462),
        (0.254, 0.030, 0.552),
        (0.262, 0.456, 0.007),
        (0.658, 0.014, 0.025),
        (0.025, 0.031, 0.047),
    ],
    dtype=np.float32,
)
"""Linear rgb: blue as in Kosaka 2008, chapter 4, green, pink, turquoise, violet, lime, red, slate.

The first ones are the farthest from the orange of the wire.
"""


def colors_of(clusters: NDArray[np.int32]) -> NDArray[np.float32]:
    """Colour (P, 3), linear rgb, of particles in clusters (P,); the table begins anew after its end."""
    return np.asarray(CLUSTER_COLORS[clusters % len(CLUSTER_COLORS)])
