"""Edges of a triangle mesh that pierce its triangles, counted."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.quality.crossings import pierced_triangles as pierced_pairs

if TYPE_CHECKING:
    from balloon_usd.bench.pinch_task import Floats, Ints


def pierced_triangles(points: Floats, triangles: Ints) -> int:
    """Return how many pairs there are of an edge and a triangle that it passes through, of no common vertex.

    `points`: (V, 3), m. `triangles`: (T, 3).
    """
    return len(pierced_pairs(points, triangles.astype(np.int64)).triangles)
