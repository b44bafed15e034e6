"""Which corners of which faces meet at a vertex."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def corner_table(quads: NDArray[np.int32], vertices: int) -> NDArray[np.int32]:
    """Return for every vertex the corners (4 q + corner) that meet there, (V, 4) int32, else -1.

    Raises:
        ValueError: more than four quads meet at a vertex.
    """
    flat = quads.reshape(-1)
    order = np.argsort(flat, kind="stable")
    counts = np.bincount(flat, minlength=vertices)
    if counts.max() > 4:
        raise ValueError(f"at most 4 quads may meet at a vertex, {counts.max()} do")
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
    table = np.full((vertices, 4), -1, dtype=np.int32)
    place = np.arange(len(flat)) - np.repeat(starts, counts)
    table[flat[order], place] = order
    return table
