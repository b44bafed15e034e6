"""The way of a net's joints to their places in space."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.motions.opening import fit, half_turn_vector, opening_path
from balloon_usd.solver.rotations import rotation

TURNED = rotation(np.array([0.4, -1.1, 0.7]))
WIDTH = 0.05
"""Of bubbles."""
SIDES = [(0, 1), (1, 2), (2, 3), (3, 4)]
CUBE = np.array([(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0), (1, 1, 0), (1, 0, 0), (1, 0, 1)], dtype=float)
RING = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (5, 6), (6, 1)]


def distances(places):
    return np.linalg.norm(places[:, None] - places, axis=2)


def lengths(places, sides):
    first, second = np.array(sides).T
    return np.linalg.norm(places[first] - places[second], axis=1)


def test_a_net_ends_in_its_shape_and_the_middle_of_its_joints_stays():
    began = np.array([(0.0, 0, 0), (1, 0, 0), (2, 0, 0.2), (3, 0.1, 0), (4, 0, 0)])
    path = opening_path(began, CUBE[:5] @ TURNED.T + 7.0, SIDES, np.zeros(3), WIDTH)
    assert path[0] == pytest.approx(began)
    assert distances(path[-1]) == pytest.approx(distances(CUBE[:5]))
    assert np.ptp(path.mean(axis=1), axis=0) == pytest.approx(0.0, abs=1e-9)


def test_bubbles_keep_their_lengths_on_the_way():
    began = np.array([(0.0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0), (4, 0, 0)])
    for pose in opening_path(began, CUBE[:5], SIDES, CUBE[5], WIDTH):
        assert lengths(pose, SIDES) == pytest.approx(1.0, abs=0.05)


def test_a_net_that_has_its_shape_stays_where_it_is_unless_something_is_left_of_its_balloon():
    began = (CUBE @ TURNED.T) * (1.0, 1.0, -1.0)
    path = opening_path(began, CUBE, RING, None, WIDTH)
    assert path[-1] == pytest.approx(began, abs=1e-6)


def test_what_is_left_of_the_balloon_stands_off_the_net():
    began = CUBE @ TURNED.T
    last = opening_path(began, CUBE, RING, CUBE[-1], WIDTH)[-1]
    others = last[:-1] - last[-1]
    assert distances(last) == pytest.approx(distances(CUBE))
    assert (others[:, 0] < 0.0).all()


def test_joints_that_are_not_in_the_net_yet_do_not_mirror_it():
    began = CUBE @ TURNED.T
    began[-1] = 9.0, 0.0, 0.0
    turned, _ = fit(CUBE, began)
    assert turned == pytest.approx(TURNED, abs=0.02)


def test_a_net_of_one_joint_so_far_has_no_gap_to_look_for():
    began = np.array([(0.0, 0, 0), (0.02, 0, 0)])
    path = opening_path(began, np.zeros((2, 3)), [(0, 1)], np.array([0.0, 1.0, 0.0]), WIDTH)
    assert np.isfinite(path).all()


def test_what_is_left_of_a_balloon_leaves_a_net_where_no_bubble_is():
    across = np.array([(0.15, 0, 1), (0.15, 0, -1), (-1, 1, 0), (-1, -1, 0), (0, 0, 0)], dtype=float)
    sides = [(0, 1), (2, 4), (3, 4)]
    onward = np.array([1.0, 0.0, 0.0])
    *_, through = opening_path(across, across, sides, onward, 1e-3)
    *_, beside = opening_path(across, across, sides, onward, 0.1)
    for last, blocked in ((through, True), (beside, False)):
        bar, begin = last[:2], last[-1]
        along = bar[0] + np.linspace(0.0, 1.0, 101)[:, None] * (bar[1] - bar[0])
        off = along - begin
        assert (np.hypot(off[:, 1], off[:, 2])[off[:, 0] > 0.0].min(initial=9.0) < 0.09) == blocked


@pytest.mark.parametrize("angle", [0.0, 1e-7, 0.5, 3.1, np.pi])
def test_a_rotation_is_found_again_up_to_half_a_turn(angle):
    matrix = rotation(angle * np.array([0.6, 0.0, -0.8]))
    assert rotation(half_turn_vector(matrix)) == pytest.approx(matrix, abs=1e-6)
