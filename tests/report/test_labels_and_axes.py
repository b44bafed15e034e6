"""Labels keep apart, and axes have round marks."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from balloon_usd.report.axis import time_axis, value_axis
from balloon_usd.report.labels import rows_for, spread
from balloon_usd.report.palette import bubble_color

PLACES = st.lists(st.floats(0.0, 100.0), min_size=1, max_size=12)


@given(PLACES)
def test_labels_are_apart_within_and_in_order(wanted):
    found = spread(wanted, 8.0, 0.0, 100.0)
    assert all(-1e-6 <= place <= 100.0 + 1e-6 for place in found)
    pairs = sorted(zip(wanted, found, strict=True))
    assert all(b >= a + 8.0 - 1e-6 for a, b in zip(sorted(found), sorted(found)[1:], strict=False))
    assert all(q >= p - 1e-6 or a == b for (a, p), (b, q) in zip(pairs, pairs[1:], strict=False))


def test_labels_that_have_room_stay_where_they_belong():
    assert spread([50.0, 10.0, 90.0], 16.0, 0.0, 100.0) == [50.0, 10.0, 90.0]


def test_labels_without_room_are_spread_evenly():
    assert sorted(spread([5.0] * 5, 50.0, 0.0, 100.0)) == pytest.approx([0, 25, 50, 75, 100])


def test_steps_that_would_overlap_go_to_a_higher_row():
    assert rows_for([0, 50, 60, 200], [100, 20, 20, 20], 10) == [0, 1, 2, 0]


@given(st.integers(-(10**9), 10**9), st.integers(0, 10**9))
def test_an_axis_covers_its_values_with_a_few_marks(low, span):
    low, span = 1e-3 * low, 1e-3 * span
    axis = value_axis(low, low + span, 300.0, 0.0)
    assert axis.low <= low + 1e-6 * max(abs(low), span)
    assert axis.high >= low + span - 1e-6 * max(abs(low), span)
    assert 2 <= len(axis.ticks) <= 9


def test_marks_are_round_and_written_alike():
    axis = value_axis(0.0, 7.3, 300.0, 0.0)
    assert [axis.text(tick) for tick in axis.ticks] == ["0", "2", "4", "6", "8"]
    fine = value_axis(0.0, 1.1, 300.0, 0.0)
    assert [fine.text(tick) for tick in fine.ticks][:3] == ["0.00", "0.25", "0.50"]


def test_time_ends_where_the_frames_end():
    axis = time_axis(0.0, 18.79, 0.0, 1000.0)
    assert axis.place(18.79) == 1000.0
    assert axis.ticks[-1] == 18.0


def test_bubbles_have_colours_of_their_own():
    assert len({bubble_color(index) for index in range(20)}) == 20
