"""How deep walls lie in each other."""

from __future__ import annotations

import numpy as np
import pytest

from tests.crossing import deepest_crossing


def block(corner, size):
    """A box of six quads."""
    unit = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return (np.array(corner) + unit * size).astype(np.float32), np.array(quads, dtype=np.int32)


def test_two_boxes_apart_do_not_cross():
    crossing = deepest_crossing([block((0, 0, 0), 0.1), block((0.2, 0, 0), 0.1)])
    assert crossing.depth == 0.0
    assert crossing.vertices == 0


def test_a_small_box_in_the_side_of_a_large_one_is_as_deep_as_it_reaches():
    large, small = block((0, 0, 0), 0.1), block((0.097, 0.04, 0.04), 0.02)
    crossing = deepest_crossing([large, small])
    assert crossing.depth == pytest.approx(0.003, rel=1e-3)
    assert crossing.vertices == 4
    assert crossing.place[0] == pytest.approx(0.097)


def test_the_order_of_balloons_does_not_matter():
    large, small = block((0, 0, 0), 0.1), block((0.097, 0.04, 0.04), 0.02)
    assert deepest_crossing([small, large]).depth == pytest.approx(deepest_crossing([large, small]).depth)
