from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.preview.render import quad_surface
from balloon_usd.preview.subdivide import subdivision_step
from balloon_usd.preview.surface import SmoothSurface

CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float32)
CUBE_QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


def grid(n: int) -> tuple[np.ndarray, np.ndarray]:
    x, y = np.meshgrid(np.arange(n + 1.0), np.arange(n + 1.0))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1).astype(np.float32)
    i, j = np.meshgrid(np.arange(n), np.arange(n))
    a = (j * (n + 1) + i).ravel()
    return points, np.stack([a, a + 1, a + n + 2, a + n + 1], axis=1)


def test_one_step_on_a_cube_gives_the_points_of_catmull_and_clark():
    step = subdivision_step(np.full(6, 4), CUBE_QUADS.ravel(), 8)
    refined = step.refine(CUBE)
    assert np.allclose(np.abs(refined[:8]), 5 / 9)
    assert np.allclose(np.sort(np.abs(refined[8:20]), axis=1), [0, 0.75, 0.75])
    assert np.allclose(np.sort(np.abs(refined[20:]), axis=1), [0, 0, 1])


def test_a_flat_sheet_stays_flat_and_keeps_its_border_and_corners():
    points, quads = grid(3)
    surface = SmoothSurface(np.full(9, 4), quads.ravel(), levels=2)
    refined = surface.refine(points)
    assert np.all(refined[:, 2] == 0)
    assert refined[:, :2].min() == 0
    assert refined[:, :2].max() == 3
    assert {(0, 0), (3, 3), (0, 3), (3, 0)} <= {tuple(p) for p in refined[:, :2].tolist()}


def test_a_tube_of_twelve_becomes_round_within_a_thousandth(chain):
    points, quads, _ = chain
    refined = quad_surface(quads).refine(points)
    middle = refined[(refined[:, 0] > 0.26) & (refined[:, 0] < 0.29)]
    radius = np.hypot(middle[:, 1], middle[:, 2])
    assert len(radius) > 40
    assert np.ptp(radius) < 1e-3 * radius.mean()


def test_normals_are_unit_and_point_outwards(chain):
    points, quads, _ = chain
    surface = quad_surface(quads)
    refined = surface.refine(points)
    normals = surface.normals(refined)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
    body = (refined[:, 0] > 0.22) & (refined[:, 0] < 0.33)
    assert np.all(np.sum(normals[body, 1:] * refined[body, 1:], axis=1) > 0)


def test_a_quad_with_a_repeated_corner_is_a_triangle():
    pyramid = [[0, 1, 2, 2], [0, 2, 3, 3], [0, 3, 1, 1], [1, 3, 2, 2]]
    surface = quad_surface(pyramid)
    triangles = SmoothSurface(np.full(4, 3), np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]).ravel())
    points = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0], [-1, -1, 0]], dtype=np.float32)
    assert np.array_equal(surface.refine(points), triangles.refine(points))


def test_every_refined_quad_lies_on_the_cage_face_that_it_names():
    points, quads = grid(4)
    surface = SmoothSurface(np.full(16, 4), quads.ravel(), levels=1)
    centres = surface.refine(points)[surface.quads].mean(axis=1)
    cage = points[quads].mean(axis=1)[surface.cage_face]
    assert np.abs(centres - cage).max() < 0.51


def test_points_without_a_face_are_left_out():
    points, quads = grid(2)
    padded = np.concatenate([[[9, 9, 9]], points]).astype(np.float32)
    assert np.array_equal(quad_surface(quads + 1).refine(padded), quad_surface(quads).refine(points))


def test_vertex_values_spread_as_points_do(chain):
    _, quads, _ = chain
    surface = quad_surface(quads)
    constant = np.full((surface.cage_count, 3), 0.25, dtype=np.float32)
    assert surface.spread(constant).shape == (surface.vertex_count, 3)
    assert np.allclose(surface.spread(constant), 0.25, atol=1e-6)


@pytest.mark.parametrize("levels", [1, 2])
def test_a_level_makes_four_quads_of_each(levels):
    surface = SmoothSurface(np.full(6, 4), CUBE_QUADS.ravel(), levels=levels)
    assert len(surface.quads) == 6 * 4**levels
    assert surface.vertex_count == surface.quads.max() + 1
