"""Corners of faces: which of them meet at a vertex, and the areas between them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def corner_table(quads: NDArray[np.int32], vertices: int) -> NDArray[np.int32]:
    """Return for every vertex the corners (4 q + corner) that meet there, (V + R, 4) int32, else -1.

    A vertex at which more than four quads meet has three in its own row, and -2 - row in the fourth slot:
    there, in one of R further rows, follow three more, and so on.
    """
    flat = quads.reshape(-1)
    order = np.argsort(flat, kind="stable").astype(np.int32)
    counts = np.bincount(flat, minlength=vertices)
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
    place = np.arange(len(flat)) - np.repeat(starts, counts)
    crowded = counts > 4
    rows = np.where(crowded, -(-counts // 3), 1)
    first = vertices + np.concatenate([[0], np.cumsum(rows - 1)[:-1]])
    table = np.full((vertices + int((rows - 1).sum()), 4), -1, dtype=np.int32)
    at, own = flat[order], ~crowded[flat[order]]
    table[at[own], place[own]] = order[own]
    further = place // 3
    row = np.where(further == 0, at, first[at] + further - 1)
    table[row[~own], place[~own] % 3] = order[~own]
    for vertex in np.flatnonzero(crowded):
        chain = [vertex, *range(first[vertex], first[vertex] + rows[vertex] - 1)]
        table[chain[:-1], 3] = -2 - np.array(chain[1:])
    return table


def vector_areas(points: NDArray[np.floating[Any]], quads: NDArray[np.integer[Any]]) -> NDArray[np.float64]:
    """Return the outward vector areas of quads (Q, 4) between points (V, 3), m, (Q, 3), m2."""
    corners = points[quads].astype(float)
    return np.asarray(0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]))
