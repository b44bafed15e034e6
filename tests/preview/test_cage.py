from __future__ import annotations

import numpy as np

from balloon_usd.preview import Cage

CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float32)
QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


def cube(shift: int = 0) -> Cage:
    return Cage(np.full(6, 4), QUADS.ravel() + shift)


def test_a_cube_has_twelve_edges_each_once():
    edges = cube().edges
    assert len(edges) == 12
    assert len(np.unique(np.sort(edges, axis=1), axis=0)) == 12
    assert np.allclose(np.linalg.norm(CUBE[edges[:, 0]] - CUBE[edges[:, 1]], axis=1), 2)


def test_the_normals_of_a_cubes_edges_point_outwards_diagonally():
    cage = cube()
    middles = CUBE[cage.edges].mean(axis=1)
    assert np.allclose(cage.edge_normals(CUBE), middles / np.sqrt(2), atol=1e-6)


def test_an_edge_has_the_mean_colour_of_its_faces():
    cage = cube()
    values = cage.edge_values(np.eye(6, 3, dtype=np.float32))
    assert np.isclose(values.sum(), 4 * 3 / 2)
    assert set(np.unique(values)) <= {0.0, 0.5}


def test_a_repeated_corner_makes_no_edge():
    pyramid = Cage(np.full(4, 4), np.array([[0, 1, 2, 2], [0, 2, 3, 3], [0, 3, 1, 1], [1, 3, 2, 2]]).ravel())
    assert len(pyramid.edges) == 6
    points = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0], [-1, -1, 0]], dtype=np.float32)
    assert np.isfinite(pyramid.edge_normals(points)).all()


def test_points_without_a_face_are_left_out():
    padded = np.concatenate([np.full((3, 3), 9), CUBE]).astype(np.float32)
    cage = cube(shift=3)
    assert cage.used_count == 8
    assert np.array_equal(cage.used_points(padded), CUBE)
    assert np.array_equal(cage.edges, cube().edges)


def test_fans_cover_every_face_once():
    mixed = Cage([3, 5], [0, 1, 2, 2, 1, 3, 4, 5])
    triangles, faces = mixed.triangles()
    assert faces.tolist() == [0, 1, 1, 1]
    assert triangles.tolist() == [[0, 1, 2], [2, 1, 3], [2, 3, 4], [2, 4, 5]]
    triangles, faces = cube().triangles()
    corner = CUBE[triangles]
    areas = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1) / 2
    assert np.allclose(np.bincount(faces, weights=areas), 4)
