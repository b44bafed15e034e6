"""Edges that pierce faces are counted exactly."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.quality.boxes import overlapping_boxes
from balloon_usd.quality.crossings import pierced_triangles
from balloon_usd.quality.depth import deepest
from balloon_usd.quality.walls import halves
from tests.quality import surfaces
from tests.quality.surfaces import block, by_hand


def together(*blocks):
    """Boxes as triangles, with the quad of each."""
    points, quads = surfaces.together(*blocks)
    return points, halves(quads), np.tile(quads, (2, 1))


def test_two_boxes_apart_do_not_cross():
    points, triangles, faces = together(block((0, 0, 0), 0.1), block((0.2, 0, 0), 0.1))
    assert len(pierced_triangles(points, triangles, faces).triangles) == 0


def test_boxes_with_a_common_side_touch_and_do_not_cross():
    points, triangles, faces = together(block((0, 0, 0), 0.1), block((0.1, 0.03, 0.02), 0.05))
    assert len(pierced_triangles(points, triangles, faces).triangles) == 0


def test_a_small_box_in_the_side_of_a_large_one_pierces_it_as_deep_as_it_reaches():
    points, triangles, faces = together(block((0, 0, 0), 0.1), block((0.097, 0.042, 0.041), 0.02))
    pierced = pierced_triangles(points, triangles, faces)
    # Four edges along x and two diagonals beside them; of the large side the diagonal, through two of its own.
    into_large = pierced.triangles[pierced.edges.min(axis=1) >= 8]
    assert len(into_large) == 8
    assert (triangles[into_large] < 8).all()
    assert deepest(points, triangles, np.unique(pierced.edges)) == pytest.approx(0.003, rel=1e-3)


def test_what_is_outside_has_no_depth():
    points, triangles, _ = together(block((0, 0, 0), 0.1), block((0.2, 0, 0), 0.1))
    assert deepest(points, triangles, np.arange(len(points))) == 0.0


def test_faces_that_share_a_vertex_with_an_edge_are_its_neighbours():
    # The last corner of a quad stands above its first half; two edges go down from there, through that half.
    points = np.array(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0.6, 0.2, 0.1], [0.6, 0.2, -0.4], [2, 2, -2]], dtype=float
    )
    triangles = np.array([[0, 1, 2], [0, 2, 3], [3, 4, 5]])
    faces = np.array([[0, 1, 2, 3], [0, 1, 2, 3], [3, 4, 5, 5]])
    assert len(pierced_triangles(points, triangles).triangles) == 2
    assert len(pierced_triangles(points, triangles, faces).triangles) == 0


@pytest.mark.parametrize("seed", range(4))
def test_the_count_is_that_of_all_pairs_in_integers_of_any_size(seed):
    random = np.random.default_rng(seed)
    # Few places, so that many edges touch, lie in planes of faces, or meet corners.
    points = random.integers(0, 5, (60, 3))
    triangles = np.array([random.choice(60, 3, replace=False) for _ in range(50)])
    pierced = pierced_triangles(points * 2.0**-9, triangles)
    found = {
        (*edge, index) for edge, index in zip(pierced.edges.tolist(), pierced.triangles.tolist(), strict=True)
    }
    assert found == by_hand(points, triangles)
    assert len(found) > 20


def test_a_vertex_sixty_nanometres_behind_a_face_pierces_it_and_one_in_it_does_not():
    near = np.array([[0, 0, 0], [0.02, 0, 0], [0, 0.02, 0], [0.005, 0.005, 0.01], [0.009, 0.005, 0.01]])
    triangles = np.array([[0, 1, 2], [3, 4, 5]])
    for depth, count in ((0.0, 0), (6e-8, 2)):
        points = np.concatenate([near, [[0.006, 0.006, -depth]]]) + 1.0
        assert len(pierced_triangles(points, triangles).triangles) == count


@pytest.mark.parametrize("seed", range(3))
def test_boxes_that_overlap_are_found_and_no_others(seed):
    random = np.random.default_rng(seed)
    low, other = random.integers(-1000, 1000, (300, 3)), random.integers(-1000, 1000, (200, 3))
    high, other_high = low + random.integers(0, 200, (300, 3)), other + random.integers(0, 90, (200, 3))
    over = (other[None] <= high[:, None]) & (other_high[None] >= low[:, None])
    expected = np.argwhere(over.all(axis=2))
    assert len(expected) > 20
    assert overlapping_boxes(low, high, other, other_high).tolist() == expected.tolist()


def test_nothing_overlaps_nothing():
    none, some = np.zeros((0, 3), dtype=np.int64), np.zeros((2, 3), dtype=np.int64)
    assert overlapping_boxes(none, none, some, some).shape == (0, 2)
