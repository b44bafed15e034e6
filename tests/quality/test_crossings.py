"""Edges that pierce faces are counted exactly."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.quality.boxes import overlapping_boxes
from balloon_usd.quality.crossings import pierced_among, pierced_triangles
from balloon_usd.quality.depth import deepest
from balloon_usd.quality.orientation import sides_of
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


def test_an_edge_two_micrometres_beside_a_triangle_does_not_pierce_it_however_flat_it_lies():
    # Two bubbles of a crown that press on each other: rounded to 60 nm, the edge would pierce the triangle.
    points = np.array(
        [
            [1.929174542427063, -0.26507368683815, -0.276908814907074],
            [1.933136224746704, -0.26107141375541687, -0.27123257517814636],
            [1.9342331886291504, -0.26276397705078125, -0.2755800485610962],
            [1.9327186346054077, -0.2640863358974457, -0.27723345160484314],
            [1.9275387525558472, -0.26377376914024353, -0.2731013596057892],
        ]
    )
    edge, triangles, index = np.array([[0, 1]]), np.array([[2, 4, 3]]), np.array([0])
    for unit, count in ((0.0, 0), (2.0**-24, 1)):
        places = np.round(points / unit) * unit if unit else points
        assert len(pierced_among(places, edge, triangles, index).triangles) == count


def test_the_side_of_a_plane_is_exact_where_double_precision_is_not():
    # 0.5 and 12 lie on the line x = y; steps of 2^-53 to either side of it are lost in products.
    around = np.arange(-32, 33)
    points = np.zeros((len(around), 3))
    points[:, 0] = 0.5 + around * 2.0**-53
    points[:, 1] = 0.5
    a, b, c = (
        np.tile(corner, (len(points), 1)) for corner in ([12.0, 12.0, 0], [24.0, 24.0, 0], [24, 24, 9])
    )
    assert sides_of(a, b, c, points).tolist() == np.sign(points[:, 0] - 0.5).astype(int).tolist()


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
