"""Threads and lids: faces that a mesh keeps where its wall has torn. They are no walls."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.quality.crossings import Pierced

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Numbers = NDArray[np.int64]

WIDTH = 5.0e-5
"""Longest of two opposite sides of a face of a thread, m: those of `solver.torn` are up to 8e-6 long."""
LENGTH = 10.0 * WIDTH
"""Least length of the two others, m."""


def walls_alone(pierced: Pierced, quads: Numbers, points: NDArray[np.floating]) -> Pierced:
    """Return the pairs of which neither the edge nor the face ends in a thread.

    `quads`: all faces, (F, 4) vertices; `points`: where these are, (V, 3), m.
    """
    if not len(pierced.edges):
        return pierced
    thread = _in_threads(quads, points)
    if not thread.any():
        return pierced
    around = quads[pierced.triangles % len(quads)]
    walls = ~thread[np.concatenate([pierced.edges, around], axis=1)].any(axis=1)
    return Pierced(pierced.edges[walls], pierced.triangles[walls], pierced.behind[walls])


def _in_threads(quads: Numbers, points: NDArray[np.floating]) -> NDArray[np.bool_]:
    """Tell which vertices are of a thread, or of the middle of a lid, (V,): no triangle is of any."""
    corners = points[quads]
    sides = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    sides[quads[:, 2] == quads[:, 3]] = WIDTH
    narrow, long = sides < WIDTH, sides > LENGTH
    thin = narrow & np.roll(narrow, 2, axis=1) & np.roll(long, 1, axis=1) & np.roll(long, -1, axis=1)
    found = np.zeros(len(points), dtype=bool)
    if thin.any():
        face, side = np.nonzero(narrow)
        found[quads[face, side]] = found[quads[face, (side + 1) % 4]] = True
    return found
