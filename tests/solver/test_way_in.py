"""The way on which a balloon comes in."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.motions.way_in import BESIDE, CLEAR, TILT, way_in

HELD = np.zeros(3)
RING = np.array([0.0, 0.6, 0.0])


def tube(first, last, count=20):
    return np.linspace(first, last, count)


COMING = tube(RING, RING + (0.8, 0.0, 0.0))
FIGURE = tube((-0.4, 0.0, 0.0), (0.5, 0.0, 0.0))


def test_a_balloon_comes_straight_from_its_side_and_ends_beside_the_joint_with_its_rest_turned_off():
    way = way_in(RING, HELD, COMING, FIGURE, None)
    assert way.lift == 0.0
    assert way.place(0.0) == pytest.approx(RING)
    assert way.place(1.0) == pytest.approx((0.0, BESIDE, 0.0))
    tip = way.pose(1.0, COMING)[-1] - way.place(1.0)
    assert tip == pytest.approx((0.8 * np.cos(TILT), 0.8 * np.sin(TILT), 0.0))


def test_one_that_hangs_on_both_sides_of_its_joint_is_not_turned():
    coming = tube(RING - (0.3, 0.0, 0.0), RING + (0.8, 0.0, 0.0))
    assert way_in(RING, HELD, coming, FIGURE, None).angle == 0.0


def test_it_keeps_its_shape_on_the_way():
    way = way_in(RING, HELD, COMING, FIGURE, None)
    for share in (0.0, 0.3, 1.0):
        apart = np.diff(way.pose(share, COMING), axis=0)
        assert np.linalg.norm(apart, axis=1) == pytest.approx(np.full(19, 0.8 / 19))


def test_it_goes_over_what_lies_between():
    between = tube((-0.4, 0.35, 0.0), (1.2, 0.35, 0.0), 60)
    way = way_in(RING, HELD, COMING, np.concatenate([FIGURE, between]), None)
    assert way.lift != 0.0
    assert way.clearance(COMING, between, None) >= CLEAR


def test_it_comes_to_another_side_where_something_sticks_out():
    spike = tube((0.2, 0.05, 0.0), (0.2, 0.3, 0.0))
    way = way_in(RING, HELD, COMING, np.concatenate([FIGURE, spike]), None)
    assert way.end[2] != 0.0
    assert way.clearance(COMING, spike, None) >= CLEAR


def test_one_of_which_nothing_more_is_made_stands_off_the_figure():
    way = way_in(RING, HELD, COMING, FIGURE, None, done=True)
    assert way.angle > TILT
    joined = way.pose(1.0, COMING) - way.end
    far = joined[np.linalg.norm(joined, axis=1) > 0.1]
    assert np.linalg.norm(far[:, None] - FIGURE, axis=2).min() >= CLEAR


def test_it_comes_to_the_side_where_it_will_lie_in_a_net():
    way = way_in(RING, HELD, COMING, FIGURE, np.array([0.3, -0.1, -0.9]))
    assert way.end == pytest.approx((0.0, 0.0, -BESIDE))
    assert way.clearance(COMING, FIGURE, None) >= CLEAR
