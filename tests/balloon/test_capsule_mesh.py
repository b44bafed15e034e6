"""The capsule of the experiment is one closed surface of even quads on hemispheres and a cylinder."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.balloon.capsule_mesh import capsule_mesh
from tests.balloon.volume import volume_of

LENGTH, RADIUS = 0.20, 0.0255


def experiment(around=32, ends=(0.05, 0.08, LENGTH)):
    return capsule_mesh(LENGTH, RADIUS, around, ends)


def edge_lengths(mesh):
    edges = np.concatenate([mesh.quads[:, [k, (k + 1) % 4]] for k in range(4)])
    return np.linalg.norm(mesh.points[edges[:, 0]] - mesh.points[edges[:, 1]], axis=1)


def test_the_experiments_capsule_has_the_vertices_and_faces_of_the_thesis():
    mesh = experiment()
    assert len(mesh.points) == 1602
    assert len(mesh.quads) == 1600
    assert len(mesh.ring_start) == 47


@pytest.mark.parametrize("around", [8, 32, 48, 64])
@pytest.mark.parametrize("length", [2.0 * RADIUS, 0.12, LENGTH, 1.5])
def test_every_edge_is_shared_by_two_quads_in_opposite_directions(around, length):
    mesh = capsule_mesh(length, RADIUS, around, (length,))
    edges = np.concatenate([mesh.quads[:, [k, (k + 1) % 4]] for k in range(4)])
    there, back = {tuple(e) for e in edges}, {tuple(e[::-1]) for e in edges}
    assert len(there) == len(edges)
    assert there == back
    assert set(mesh.quads.ravel()) == set(range(len(mesh.points)))
    assert len(mesh.points) == len(mesh.quads) + 2


@pytest.mark.parametrize("around", [32, 48, 64])
def test_the_surface_faces_outwards_and_comes_nearer_to_the_capsules_volume(around):
    exact = math.pi * RADIUS**2 * (LENGTH - 2.0 * RADIUS + 4.0 / 3.0 * RADIUS)
    mesh = experiment(around)
    missing = 1.0 - volume_of(mesh.points, mesh.quads) / exact
    # A polygon of n sides lacks 2 pi^2 / (3 n^2) of its circle.
    assert 0.0 < missing < 1.3 * 2.0 * math.pi**2 / (3.0 * around**2)


def test_all_vertices_lie_on_the_capsule():
    points = experiment().points.astype(float)
    core = np.clip(points[:, 0], RADIUS, LENGTH - RADIUS)
    away = np.linalg.norm(np.column_stack([points[:, 0] - core, points[:, 1:]]), axis=1)
    assert away == pytest.approx(RADIUS, rel=1e-5)


def test_edges_are_even_to_what_the_circle_at_45_degrees_allows():
    lengths = edge_lengths(experiment())
    hoop = 2.0 * RADIUS * math.sin(math.pi / 32)
    assert lengths.min() == pytest.approx(hoop * math.sqrt(0.5), rel=1e-4)
    assert lengths.max() < 1.05 * hoop


def test_rows_are_even_along_the_meridian_and_as_high_at_every_length():
    heights = []
    for length in (0.1, LENGTH, 0.7):
        mesh = capsule_mesh(length, RADIUS, 32, (length,))
        line = mesh.points[mesh.ring_start]
        heights.append(np.linalg.norm(np.diff(line, axis=0), axis=1))
        assert heights[-1] == pytest.approx(heights[-1].mean(), rel=0.01)
    assert [h.mean() for h in heights] == pytest.approx([heights[1].mean()] * 3, rel=0.03)


def test_caps_end_45_degrees_from_the_poles():
    mesh = experiment()
    depth = RADIUS * (1.0 - math.sqrt(0.5))
    assert mesh.ring_along[[0, -1]] == pytest.approx([depth, LENGTH - depth])
    assert mesh.along.min() == pytest.approx(0.0, abs=1e-9)
    assert mesh.along.max() == pytest.approx(LENGTH)
    assert mesh.along == pytest.approx(mesh.points[:, 0])


def test_between_rings_the_first_edge_runs_round_and_the_second_along():
    mesh = experiment()
    first, second, third, _ = mesh.quads[64]
    assert mesh.along[first] == mesh.along[second]
    assert mesh.along[third] > mesh.along[second]


def test_bubbles_take_the_faces_up_to_the_ring_nearest_to_their_end():
    mesh = experiment()
    faces = 64 + 32 * np.array([mesh.ring_at(0.05), mesh.ring_at(0.08)])
    assert np.flatnonzero(np.diff(mesh.quad_bubble)) + 1 == pytest.approx(faces)
    assert (mesh.quad_bubble[0], mesh.quad_bubble[-1]) == (0, 2)


def test_texture_runs_once_round_and_once_along():
    st = experiment().st
    assert st.shape == (1600, 4, 2)
    assert (st.min(), st[..., 1].max(), st[..., 0].max()) == (0.0, 1.0, 3.0)


@pytest.mark.parametrize(
    ("length", "radius", "around"), [(0.05, 0.0255, 32), (math.nan, 0.02, 32), (0.1, 0.0, 32)]
)
def test_a_capsule_wider_than_long_is_refused(length, radius, around):
    with pytest.raises(ValueError, match="at least twice as long"):
        capsule_mesh(length, radius, around, (length,))


@pytest.mark.parametrize("around", [0, 4, 30])
def test_rings_that_no_square_cap_fits_are_refused(around):
    with pytest.raises(ValueError, match="multiple of four"):
        capsule_mesh(LENGTH, RADIUS, around, (LENGTH,))
