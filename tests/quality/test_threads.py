"""Threads and lids where a wall has torn are no walls; all other faces are, however small."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.quality.crossings import pierced_triangles
from balloon_usd.quality.threads import walls_alone
from balloon_usd.quality.walls import halves


def tube(radii, heights):
    """Return the points and the quads of a tube of eight corners with these radii at these heights, m."""
    turn = 2.0 * np.pi * np.arange(8) / 8
    rings = [
        np.column_stack([r * np.cos(turn), r * np.sin(turn), np.full(8, z)])
        for r, z in zip(radii, heights, strict=True)
    ]
    k = np.arange(8)
    quads = [
        np.stack([8 * j + k, 8 * j + (k + 1) % 8, 8 * j + 8 + (k + 1) % 8, 8 * j + 8 + k], axis=1)
        for j in range(len(radii) - 1)
    ]
    return np.concatenate(rings), np.concatenate(quads)


def crossings(points, quads):
    """Return how many edges pierce triangles, without those of threads."""
    triangles = halves(quads)
    pierced = pierced_triangles(points, triangles, np.tile(quads, (2, 1)))
    assert len(pierced.edges)
    return len(walls_alone(pierced, quads, points).edges)


def with_sheet(points, quads, height):
    """Return the same with a square sheet of 4 cm across it at a height, m."""
    sheet = np.array(
        [[-0.021, -0.019, height], [0.02, -0.02, height], [0.019, 0.021, height], [-0.02, 0.02, height]]
    )
    return np.concatenate([points, sheet]), np.concatenate([quads, len(points) + np.arange(4)[None]])


TORN = [0.01, 2.0e-5, 1.0e-5, 1.0e-5, 2.0e-5, 0.01], [0.0, 0.0001, 0.00012, 0.05, 0.05002, 0.0501]
"""Two rags with their lids, and the thread between them."""


def test_a_sheet_across_the_thread_of_a_tear_crosses_nothing():
    assert crossings(*with_sheet(*tube(*TORN), 0.031)) == 0


def test_a_sheet_across_a_thin_tube_does():
    assert crossings(*with_sheet(*tube([0.01, 1.0e-3, 1.0e-3, 0.01], [0.0, 0.01, 0.04, 0.05]), 0.031)) >= 8


def test_a_sheet_across_a_rag_does_where_it_goes_through_its_wall():
    points, quads = tube([0.01, *TORN[0]], [-0.01, *TORN[1]])
    assert crossings(*with_sheet(points, quads, -0.004)) >= 8


@pytest.mark.parametrize("turned", [0, 1])
def test_the_order_of_a_face_s_corners_does_not_matter(turned):
    points, quads = with_sheet(*tube(*TORN), 0.031)
    assert crossings(points, np.roll(quads, turned, axis=1)) == 0


def test_triangles_that_are_long_and_thin_are_walls():
    points = np.array([[0.0, 0.0, 0.0], [2.0e-5, 0.0, 0.0], [0.0, 0.0, 0.05]])
    quads = np.array([[0, 1, 2, 2]])
    assert crossings(*with_sheet(points, quads, 0.031)) > 0
