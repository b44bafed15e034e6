"""Necks of a capsule: the wall that they take."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from balloon_usd.plan.necks import NECK_EXCESS, bubble_length, wall_length, wall_place

RADIUS = 0.0255
lengths = st.floats(0.01, 1.0)
drawn = st.tuples(st.booleans(), st.booleans())


def test_without_necks_wall_is_as_long_as_the_bubble():
    assert wall_length(0.2, RADIUS, 0) == 0.2
    assert wall_place(0.05, 0.2, RADIUS, (False, False)) == 0.05


def test_a_neck_takes_less_wall_than_a_quarter_circle_and_more_than_none():
    assert 0.0 < NECK_EXCESS < 0.5708


def test_the_round_ends_of_a_short_bubble_are_half_as_wide_as_it_is_long():
    assert wall_length(0.03, RADIUS, 2) == pytest.approx(0.03 * (1.0 + NECK_EXCESS))
    assert wall_length(0.09, RADIUS, 2) == pytest.approx(0.09 + 2.0 * NECK_EXCESS * RADIUS)


@given(lengths, st.sampled_from([0, 1, 2]))
def test_the_bubble_of_a_wall_takes_that_wall(length, necks):
    assert bubble_length(wall_length(length, RADIUS, necks), RADIUS, necks) == pytest.approx(length)


@given(lengths, drawn)
def test_places_go_from_the_start_of_the_wall_to_its_end_without_turning_back(length, necks):
    places = [wall_place(length * k / 40, length, RADIUS, necks) for k in range(41)]
    assert places == sorted(places)
    assert places[0] == pytest.approx(0.0, abs=1e-12)
    assert places[-1] == pytest.approx(wall_length(length, RADIUS, sum(necks)))


@given(lengths, st.floats(0.0, 1.0))
def test_a_bubble_with_two_necks_is_the_same_from_both_sides(length, share):
    here = wall_place(share * length, length, RADIUS, (True, True))
    there = wall_place((1.0 - share) * length, length, RADIUS, (True, True))
    assert here + there == pytest.approx(wall_length(length, RADIUS, 2))


def test_beyond_a_neck_the_wall_is_as_long_as_the_bubble():
    near, far = (wall_place(at, 0.2, RADIUS, (True, False)) for at in (0.05, 0.15))
    assert far - near == pytest.approx(0.1)
