"""The search with Warp finds what NumPy and Python's integers find."""

from __future__ import annotations

import numpy as np
import pytest
import warp as wp

from balloon_usd.quality.crossings import pierced_triangles
from balloon_usd.quality.pierced_search import ROOM, PiercedSearch
from balloon_usd.quality.walls import halves
from tests.quality.surfaces import block, by_hand, together, tube

DEVICES = ["cpu", *(device.alias for device in wp.get_cuda_devices())]


def with_numpy(points, quads):
    return pierced_triangles(points.astype(np.float64), halves(quads), np.tile(quads, (2, 1)))


def assert_same(found, expected):
    """The same pairs in the same order, with the same bits."""
    for one, other in zip(found, expected, strict=True):
        assert one.tolist() == other.tolist()
        assert one.dtype == other.dtype


@pytest.mark.parametrize("seed", range(3))
def test_pairs_of_random_quads_are_those_of_numpy_and_of_integers_of_any_size(seed):
    random = np.random.default_rng(seed)
    # Few places, so that many edges touch, lie in planes of faces, or meet corners.
    places = random.integers(0, 6, (60, 3))
    quads = np.array([random.choice(60, 4, replace=False) for _ in range(30)])
    points = (places * 2.0**-9).astype(np.float32)
    found = PiercedSearch(quads).find(points)
    assert_same(found, with_numpy(points, quads))
    pairs = {(*edge, t) for edge, t in zip(found.edges.tolist(), found.triangles.tolist(), strict=True)}
    assert pairs == by_hand(places, halves(quads), np.tile(quads, (2, 1)))
    assert len(pairs) > 20


def test_a_triangle_is_a_quad_whose_last_corner_is_there_twice():
    random = np.random.default_rng(7)
    triangles = np.array([random.choice(40, 3, replace=False) for _ in range(40)])
    points = random.normal(0.0, 0.1, (40, 3)).astype(np.float32)
    found = PiercedSearch(triangles[:, [0, 1, 2, 2]]).find(points)
    assert_same(found, pierced_triangles(points.astype(np.float64), triangles))
    assert len(found.triangles) > 20


def test_one_search_follows_a_surface_that_moves():
    # A tube comes down on another one, far from the origin, passes through it and leaves it.
    points, quads = together(tube(0.02, 0.3), tube(0.02, 0.3, across=True))
    search = PiercedSearch(quads)
    # Its tree is built where all faces are in one place.
    assert_same(search.find(np.zeros_like(points, dtype=np.float32)), with_numpy(0.0 * points, quads))
    counts = []
    for height in np.linspace(0.06, -0.06, 9):
        moved = points + [3.0, -2.0, 1.0]
        moved[len(points) // 2 :, 2] += height
        moved = moved.astype(np.float32)
        found = search.find(moved)
        assert_same(found, with_numpy(moved, quads))
        counts.append(len(found.triangles))
    assert counts[0] == counts[-1] == 0
    assert min(counts[3:6]) > 20


def test_more_pairs_than_there_is_room_for_are_all_found():
    random = np.random.default_rng(3)
    quads = random.permutation(1200).reshape(-1, 4)
    points = random.uniform(0.0, 1.0, (1200, 3)).astype(np.float32)
    found = PiercedSearch(quads).find(points)
    assert len(found.triangles) > ROOM
    assert_same(found, with_numpy(points, quads))


@pytest.mark.parametrize("device", DEVICES)
def test_points_may_lie_on_the_device_already(device):
    points, quads = together(block((0, 0, 0), 0.1), block((0.09, 0.042, 0.041), 0.02))
    points = points.astype(np.float32)
    search = PiercedSearch(quads, device)
    assert_same(search.find(wp.array(points, dtype=wp.vec3, device=device)), with_numpy(points, quads))
    assert_same(search.find(points), with_numpy(points, quads))
    # Four edges along x pierce the large side, and diagonals.
    assert len(search.find(points).triangles) >= 4
