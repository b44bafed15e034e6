"""Which strokes touch which tiles of a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from balloon_usd.preview.subdivide import Indices, Points

TILE = 8
"""Pixels along the side of a tile: a pixel looks only at the strokes of its tile."""


def tiles_across(pixels: int) -> int:
    """Return how many tiles lie side by side in so many pixels."""
    return -(-pixels // TILE)


def strokes_by_tile(low: Points, high: Points, size: tuple[int, int]) -> tuple[Indices, Indices]:
    """Sort strokes into the tiles that their boxes touch.

    Args:
        low: (S, 2) corners of the boxes (pixels).
        high: (S, 2) opposite corners.
        size: width and height of the picture (pixels).

    Returns:
        The first entry of each tile and the number of entries (T + 1,), and the strokes (N,) tile after
        tile, row after row, in the order in which they were given.
    """
    tiles = np.array([tiles_across(size[0]), tiles_across(size[1])])
    first = np.clip(np.floor(low / TILE).astype(np.int64), 0, tiles)
    end = np.clip(np.floor(high / TILE).astype(np.int64) + 1, 0, tiles)
    spans = np.maximum(end - first, 0)
    counts = spans[:, 0] * spans[:, 1]
    stroke = np.repeat(np.arange(len(counts)), counts)
    place = np.arange(len(stroke)) - np.repeat(np.cumsum(counts) - counts, counts)
    row, column = np.divmod(place, np.maximum(spans[stroke, 0], 1))
    tile = (first[stroke, 1] + row) * tiles[0] + first[stroke, 0] + column
    order = np.argsort(tile, kind="stable")
    starts = np.concatenate([[0], np.cumsum(np.bincount(tile, minlength=int(tiles.prod())))])
    return starts.astype(np.int32), stroke[order].astype(np.int32)
