from __future__ import annotations

import numpy as np

from balloon_usd.preview.tiles import TILE, strokes_by_tile, tiles_across

SIZE = (5 * TILE - 3, 3 * TILE)


def tiles_of(low, high):
    """The strokes of each tile, row after row."""
    starts, strokes = strokes_by_tile(np.float32(low), np.float32(high), SIZE)
    assert len(starts) == 5 * 3 + 1
    assert starts[-1] == len(strokes)
    return [strokes[a:b].tolist() for a, b in zip(starts[:-1], starts[1:], strict=True)]


def test_tiles_cover_a_picture_whose_side_is_no_multiple():
    assert [tiles_across(pixels) for pixels in (1, TILE, TILE + 1)] == [1, 1, 2]


def test_a_stroke_is_in_every_tile_that_its_box_touches():
    tiles = tiles_of([[TILE + 1, 1]], [[3 * TILE + 1, TILE + 1]])
    assert [number for number, strokes in enumerate(tiles) if strokes] == [1, 2, 3, 6, 7, 8]


def test_strokes_keep_their_order_in_each_tile():
    tiles = tiles_of([[0, 0]] * 4, [[TILE / 2, TILE / 2], [99, 99], [1, 1], [TILE * 2, 1]])
    assert tiles[0] == [0, 1, 2, 3]
    assert tiles[1] == tiles[2] == [1, 3]
    assert tiles[14] == [1]


def test_strokes_outside_the_picture_are_in_no_tile():
    tiles = tiles_of([[-50, 0], [0, 999], [-5, -5]], [[-40, 9], [9, 1009], [999, 999]])
    assert all(strokes == [2] for strokes in tiles)


def test_no_strokes_are_no_trouble():
    assert tiles_of(np.zeros((0, 2)), np.zeros((0, 2))) == [[]] * 15
