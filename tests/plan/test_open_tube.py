"""The open tube: how twists use up the tail, and what they do when it is gone."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from balloon_usd.balloon.bubble_shape import pinch_volume
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import gauge_pressure, maxwell_state
from balloon_usd.plan.open_tube import Twisted, inflated_tube, tail_range

SIZE, LATEX = size_named("260"), rubber_named("ogden")


def test_an_untwisted_balloon_has_the_tail_it_was_left():
    tube = inflated_tube(SIZE, LATEX, 0.1)
    assert tube.tail == pytest.approx(0.1)
    assert tube.state.p_star == pytest.approx(178.363e3, rel=1e-5)


def test_a_balloon_without_tail_hardens_as_tabulated_for_the_tube_behind_its_round_tip():
    full = inflated_tube(SIZE, LATEX, 0.0)
    tip = 0.5 * pinch_volume(SIZE, full.rubber)
    after = [full, *(replace(full, volume=full.volume + twists * 77.2e-6 - tip) for twists in (5, 10, 15))]
    pressures = [gauge_pressure(SIZE, tube.state.p_star) / 1e3 for tube in after]
    assert pressures == pytest.approx([7.13, 7.34, 7.55, 7.77], abs=0.015)
    assert [tube.state.a for tube in after] == pytest.approx([5.66, 5.87, 6.06, 6.24], abs=0.015)


def test_twisting_neither_makes_nor_loses_rubber_or_gas():
    tube = inflated_tube(SIZE, LATEX, 0.0)
    for length in (0.03, 0.1, 0.25):
        shape, left = tube.pinched(Twisted(length))
        assert left.rest_length + shape.rest_length == pytest.approx(tube.rest_length)
        assert left.volume + shape.volume == pytest.approx(tube.volume)
        tube = left


def test_a_hard_tube_gives_less_rubber_and_more_gas_for_the_same_length():
    soft = inflated_tube(SIZE, LATEX, 0.1)
    hard = replace(soft, volume=1.4 * inflated_tube(SIZE, LATEX, 0.0).volume)
    (shape, _), (harder, _) = soft.pinched(Twisted(0.1)), hard.pinched(Twisted(0.1))
    assert harder.length == pytest.approx(shape.length)
    assert harder.rest_length < shape.rest_length
    assert harder.volume > shape.volume


@pytest.mark.parametrize("name", ["160", "260", "646"])
def test_a_bubble_of_a_tube_without_tail_is_as_hard_as_what_is_left(name):
    size = size_named(name)
    tube = inflated_tube(replace(size, length=12.0 * size.radius), LATEX, 0.0)
    shape, left = tube.pinched(Twisted(22.0 * size.radius))
    maxwell = maxwell_state(tube.rubber).p_star
    assert left.state.p_star > 1.05 * maxwell
    assert shape.pressure == pytest.approx(left.state.p_star / maxwell, rel=1e-3)


def test_a_soft_bubble_takes_as_much_rubber_and_leaves_gas_that_fills_more_of_the_tail():
    tube = inflated_tube(SIZE, LATEX, 0.1)
    (firm, after_firm), (soft, after_soft) = (tube.pinched(Twisted(0.05, gas)) for gas in (1.0, 0.75))
    assert soft.volume == pytest.approx(0.75 * firm.volume)
    assert soft.rest_length == firm.rest_length
    assert after_soft.volume - after_firm.volume == pytest.approx(0.25 * firm.volume)
    assert after_soft.tail < after_firm.tail
    least = [tail_range(SIZE, LATEX, [Twisted(0.05, gas)]).least for gas in (1.0, 0.75)]
    assert least[1] - least[0] == pytest.approx(after_firm.tail - after_soft.tail)


def test_the_tail_range_bounds_what_can_be_made():
    lengths = [0.1] * 6
    room = tail_range(SIZE, LATEX, [Twisted(length) for length in lengths])
    assert room.least == pytest.approx(6 * 9.21e-3, abs=1e-4)
    for tail, left in ((room.least, 0.0), (room.most, None)):
        tube = inflated_tube(SIZE, LATEX, tail)
        for length in lengths:
            _, tube = tube.pinched(Twisted(length))
        if left is None:
            assert tube.inflated_rest_length == pytest.approx(4.6e-3, abs=0.1e-3)
            assert tube.inflated_length == pytest.approx(9.3e-3, abs=0.2e-3)
        else:
            assert tube.tail == pytest.approx(left, abs=1e-9)


@settings(max_examples=30, deadline=None)
@given(tail=st.floats(0.0, 0.3), lengths=st.lists(st.floats(0.005, 0.4), max_size=12))
def test_whatever_is_twisted_tail_and_pressure_stay_sound(tail, lengths):
    tube = inflated_tube(SIZE, LATEX, tail)
    for length in lengths:
        before = tube
        _, tube = tube.pinched(Twisted(length))
        if not tube.blown_up:
            break
        assert 0.0 <= tube.tail <= before.tail
        assert tube.state.p_star >= before.state.p_star
        assert 0.0 < tube.inflated_rest_length < tube.rest_length + 1e-12
