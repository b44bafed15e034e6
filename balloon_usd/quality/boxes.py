"""Boxes along the axes that overlap, found with a grid."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Numbers = NDArray[np.int64]

PER_BOX = 2
"""Columns of the grid across the widest box: more are searched in vain, fewer hold what is far."""


def overlapping_boxes(low: Numbers, high: Numbers, other_low: Numbers, other_high: Numbers) -> Numbers:
    """Return the pairs of a box and another one that overlap or touch, (P, 2), in a fixed order.

    Each of the others lies in the column of a grid over x and y in which its lowest corner is, and columns
    are sorted by z: what overlaps a box is in the few columns about its own, in a range of each.

    Args:
        low: lowest corners of the boxes, (N, 3).
        high: highest ones, (N, 3).
        other_low: lowest corners of the others, (M, 3).
        other_high: highest ones, (M, 3).
    """
    if not len(low) or not len(other_low):
        return np.zeros((0, 2), dtype=np.int64)
    wide = max(int((high - low).max()), int((other_high - other_low).max()))
    side = wide // PER_BOX + 1
    first = np.minimum(low.min(axis=0), other_low.min(axis=0)) - wide
    reach = np.maximum(high.max(axis=0), other_high.max(axis=0)) + 1 - first
    strides = np.array([(reach[1] // side + 2) * reach[2], reach[2]])
    keys = ((other_low - first)[:, :2] // side) @ strides + (other_low - first)[:, 2]
    order = np.argsort(keys, kind="stable")
    keys = keys[order]
    column = (low - first)[:, :2] // side
    bottom, top = (low - first)[:, 2] - wide, (high - first)[:, 2]
    found = []
    for offset in product(range(-PER_BOX, PER_BOX + 1), repeat=2):
        base = (column + np.array(offset)) @ strides
        here, there = _in_ranges(keys, base + bottom, base + top)
        other = order[there]
        # Axis by axis: most pairs fall out at once.
        for axis in range(3):
            over = other_low[:, axis][other] <= high[:, axis][here]
            over &= other_high[:, axis][other] >= low[:, axis][here]
            here, other = here[over], other[over]
        found.append(np.stack([here, other], axis=1))
    pairs = np.concatenate(found)
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def _in_ranges(keys: Numbers, least: Numbers, most: Numbers) -> tuple[Numbers, Numbers]:
    """Return which of some ranges hold which places of sorted keys, as two arrays of the same length."""
    begin = np.searchsorted(keys, least, side="left")
    count = np.maximum(np.searchsorted(keys, most, side="right") - begin, 0)
    here = np.repeat(np.arange(len(least)), count)
    within = np.arange(len(here)) - np.repeat(np.cumsum(count) - count, count)
    return here, np.repeat(begin, count) + within
