"""The wall of a flat heart."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.balloon.detail import DETAILS, detail_named
from balloon_usd.balloon.heart_surface import SEEN_FROM, heart_surface
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_mesh import tube_mesh

HALF, NECK = 18.5e-3, 6.8e-3
HEART = heart_surface(HALF, NECK)
TURN = math.tau * np.arange(48) / 48


def wall():
    """Points of the wall, (N, 48, 3), m."""
    return HEART.points(HEART.along[:, None], TURN)


def flat_heart(detail):
    size = size_named("H6")
    return tube_mesh(size, detail_named(detail), (), (size.length,))


def test_it_is_as_wide_as_it_is_asked_to_be_and_as_high_as_its_lobes():
    points = wall()
    assert np.ptp(points[..., 1]) == pytest.approx(2.0 * HALF, rel=0.01)
    assert points[..., 0].max() == pytest.approx(HEART.height, rel=0.01)
    assert np.ptp(points[..., 2]) < 0.5 * np.ptp(points[..., 1])


def test_it_begins_at_its_knot_with_its_neck():
    first = HEART.points(np.zeros(1), TURN)
    assert np.abs(first[:, 0]).max() < 0.15 * NECK
    assert np.linalg.norm(first[:, 1:], axis=1) == pytest.approx(NECK, rel=0.1)


def test_its_cleft_lies_on_the_axis_far_below_the_tops_of_its_lobes():
    cleft = HEART.points(HEART.along[-1:], np.zeros(1))[0]
    assert np.abs(cleft[1:]).max() < 1e-9
    assert 0.3 * HALF < HEART.height - cleft[0] < HALF


def test_it_is_its_own_mirror_image_to_both_sides():
    points = wall()
    opposite = np.roll(points[:, ::-1], 1, axis=1)
    assert opposite * [1.0, 1.0, -1.0] == pytest.approx(points, abs=1e-9)
    beside = np.roll(opposite, 24, axis=1)
    assert beside * [1.0, -1.0, 1.0] == pytest.approx(points, abs=1e-9)


def test_rings_follow_each_other_along_the_wall_without_a_fold():
    points = wall()
    inner = points[:-1, :]
    along, about = np.diff(points, axis=0), (np.roll(points, -1, axis=1) - points)[:-1]
    outwards = np.cross(about, along)
    area = np.linalg.norm(outwards, axis=-1)
    # From a place on the axis all of it is seen, from inside.
    eye = np.array([SEEN_FROM * HALF, 0.0, 0.0])
    facing = np.einsum("nki,nki->nk", outwards, inner - eye)
    assert (facing > 0.0).all() or (facing < 0.0).all()
    assert (area > 0.0).all()


def test_its_volume_and_its_weight_are_those_of_its_mesh():
    mesh = flat_heart("full")
    inside = (mesh.along[mesh.quads] >= -1e-6).all(axis=1)
    corners = mesh.points[mesh.quads[inside]].astype(float)
    vectors = 0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    middles = corners.mean(axis=1)
    mass = (HEART.wall(middles) * np.linalg.norm(vectors, axis=1)).sum()
    assert mass == pytest.approx(HEART.area, rel=0.05)
    assert np.abs((vectors * middles).sum()) / 3.0 == pytest.approx(HEART.volume, rel=0.05)


def test_its_wall_is_thick_in_the_cleft_alone():
    ends = HEART.points(HEART.along[[0, -1]], np.zeros(2))
    assert HEART.wall(ends)[0] == pytest.approx(1.0, abs=1e-3)
    assert HEART.wall(ends)[1] > 3.0


@pytest.mark.parametrize("detail", list(DETAILS))
def test_no_face_of_its_mesh_is_thin_or_folded(detail):
    mesh = flat_heart(detail)
    corners = mesh.points[mesh.quads].astype(float)
    one, other = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    normal = np.cross(one, other)
    longest = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2).max(axis=1)
    assert (0.5 * np.linalg.norm(normal, axis=1) / longest**2).min() > 0.12
    body = corners[:, :, 0].min(axis=1) > 0.0
    middle = corners.mean(axis=1) - [SEEN_FROM * HALF, 0.0, 0.0]
    assert (np.einsum("qi,qi->q", normal, middle)[body] > 0.0).all()
