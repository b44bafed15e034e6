"""How rigid figures come to stand."""

from __future__ import annotations

from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from balloon_usd.solver.latex.motions.set_down import beside_each_other
from balloon_usd.solver.placement import Placed, Placement, turn_about, turn_between
from balloon_usd.solver.resting import nearest_in_hull, resting_direction, standing_direction

DOWN = np.array([0.0, 0.0, -1.0])
BOX = np.array(list(product((-0.05, 0.05), (-0.1, 0.1), (-0.15, 0.15))))
SIDEWAYS = np.array([0.0, 1.0, 0.0])


def tilt(points, centre):
    """Degrees by which a figure has tipped when it rests."""
    return np.degrees(np.arccos(np.clip(resting_direction(points, centre, DOWN) @ DOWN, -1.0, 1.0)))


@pytest.mark.parametrize("degrees", [0.0, 5.0, 15.0])
def test_a_box_that_is_set_down_askew_comes_to_stand_on_its_foot(degrees):
    turn = turn_about(SIDEWAYS, np.radians(degrees))
    assert tilt(BOX @ turn.T, np.zeros(3)) == pytest.approx(degrees, abs=0.3)


def test_a_box_that_leans_too_far_falls_on_its_side():
    turn = turn_about(SIDEWAYS, np.radians(25.0))
    assert tilt(BOX @ turn.T, np.zeros(3)) == pytest.approx(65.0, abs=0.5)


def test_a_box_whose_centre_is_beyond_its_foot_falls():
    assert tilt(BOX, np.array([0.04, 0.0, 0.0])) < 0.5
    assert tilt(BOX, np.array([0.06, 0.0, 0.0])) > 45.0


def test_hands_set_a_figure_on_its_foot_that_would_fall_from_where_it_was_made():
    turn = turn_about(SIDEWAYS, np.radians(25.0))
    down = standing_direction(BOX @ turn.T, np.zeros(3), DOWN)
    assert np.degrees(np.arccos(down @ DOWN)) == pytest.approx(25.0, abs=0.5)


def test_a_figure_on_three_feet_tips_until_the_shortest_touches():
    feet = np.array([[0.1, 0.0, -0.1], [-0.1, 0.1, -0.1], [-0.1, -0.1, -0.09], [0.0, 0.0, 0.1]])
    down = resting_direction(feet, np.zeros(3), DOWN)
    depth = feet[:3] @ down
    assert depth.max() - depth.min() < 5e-4


@given(st.lists(st.tuples(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0)), min_size=1, max_size=8))
def test_no_corner_lies_before_the_point_of_a_hull_that_is_nearest_to_the_origin(corners):
    vectors = np.array([(x, y, 0.0) for x, y in corners])
    nearest = nearest_in_hull(vectors, DOWN)
    assert (vectors @ nearest >= nearest @ nearest - 1e-6).all()


def test_the_smallest_turn_takes_one_direction_to_another():
    for one, other in product(np.vstack([np.eye(3), -np.eye(3)]), repeat=2):
        assert turn_about(*turn_between(one, other)) @ one == pytest.approx(other, abs=1e-12)


def test_a_placement_moves_points_rigidly():
    points = BOX.astype(np.float32)
    turn = turn_about(SIDEWAYS, 1.0)
    whole = Placement(turn.astype(np.float32), np.array([1.0, 2.0, 3.0], dtype=np.float32))
    Placed((np.arange(len(BOX)),), (whole,)).put([points])
    assert points == pytest.approx(BOX @ turn.T + [1.0, 2.0, 3.0], abs=1e-6)


def test_parts_of_several_balloons_are_put_each_by_itself():
    still = Placement.by(np.eye(3), np.zeros(3))
    up = Placement.by(np.eye(3), np.array([0.0, 0.0, 5.0]))
    points = [BOX.astype(np.float32), BOX.astype(np.float32)]
    parts = np.arange(0, len(BOX) + 3), np.arange(len(BOX) + 3, 2 * len(BOX))
    Placed(parts, (still, up)).put(points)
    assert (points[0] == BOX.astype(np.float32)).all()
    assert points[1][:3] == pytest.approx(BOX[:3])
    assert points[1][3:] == pytest.approx(BOX[3:] + [0.0, 0.0, 5.0])


def test_parts_that_would_stand_above_each_other_are_put_side_by_side():
    beside, above = BOX + [3.0, 0.0, 0.0], BOX + [0.0, 0.01, 2.0]
    shifts = beside_each_other([BOX, above, beside])
    moved = [part + shift for part, shift in zip((BOX, above, beside), shifts, strict=True)]
    spans = sorted((float(part[:, 0].min()), float(part[:, 0].max())) for part in moved)
    assert all(before[1] < after[0] for before, after in pairwise(spans))
    assert all(shift[2] == 0.0 for shift in shifts)


def test_parts_that_do_not_stand_above_each_other_stay_as_far_apart():
    shifts = beside_each_other([BOX, BOX + [50.0, 0.0, 2.0]])
    assert shifts[0] == pytest.approx(shifts[1])
