"""Shapes of pinched bubbles against the tabulated membrane quadrature."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.balloon.bubble_shape import (
    bubble_of_length,
    bubble_of_rest_length,
    pinch_volume,
    shortest_stable_bubble,
    tail_volume_per_rest_length,
    tube_volume_per_rest_length,
    twist_cost,
)
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import maxwell_state

SIZE, LATEX = size_named("260"), rubber_named("ogden")
MM, ML = 1e-3, 1e-6


@pytest.mark.parametrize(
    ("length", "diameter", "volume", "rest_length"),
    [(30.0, 37.0, 23.2, 11.96), (50.0, 46.7, 63.7, 16.65), (90.0, 50.5, 145.7, 26.33)],
)
def test_bubbles_match_the_exact_membrane(length, diameter, volume, rest_length):
    shape = bubble_of_length(SIZE, LATEX, length * MM)
    assert shape.diameter / MM == pytest.approx(diameter, abs=0.06)
    assert shape.volume / ML == pytest.approx(volume, abs=0.06)
    assert shape.rest_length / MM == pytest.approx(rest_length, abs=0.006)


def test_one_twist_fills_nine_millimetres_of_flat_tail():
    assert twist_cost(SIZE, LATEX) / MM == pytest.approx(9.2, abs=0.05)
    assert pinch_volume(SIZE, LATEX) / ML == pytest.approx(77.2, abs=0.05)


def test_the_front_takes_8_millilitres_a_millimetre():
    gain = tube_volume_per_rest_length(SIZE, LATEX) - tail_volume_per_rest_length(SIZE, LATEX)
    assert gain / (ML / MM) == pytest.approx(8.379, rel=1e-3)


def test_the_shortest_stable_bubble_of_a_260_is_24_millimetres_long():
    shortest = shortest_stable_bubble(SIZE, LATEX)
    assert shortest.length / MM == pytest.approx(24.0, abs=0.3)
    assert shortest.rest_length / MM == pytest.approx(11.23, abs=0.01)


@pytest.mark.parametrize("length", [24.5, 26.0, 50.0, 110.0, 150.0, 400.0])
def test_length_and_rest_length_are_each_others_inverse(length):
    shape = bubble_of_length(SIZE, LATEX, length * MM)
    again = bubble_of_rest_length(SIZE, LATEX, shape.rest_length)
    assert shape.length == pytest.approx(length * MM, rel=1e-9)
    assert again.length == pytest.approx(shape.length, rel=1e-9)


def test_longer_bubbles_take_more_rubber_and_more_gas_without_jumps():
    shapes = [bubble_of_length(SIZE, LATEX, length * MM) for length in np.arange(24.5, 200.0, 0.5)]
    rest = np.diff([shape.rest_length for shape in shapes]) / (0.5 * MM)
    volume = np.diff([shape.volume for shape in shapes])
    assert rest.min() > 0.0
    assert rest.max() < 0.5
    assert volume.min() > 0.0


def test_a_long_bubble_is_a_cylinder_with_two_ends():
    bulged = maxwell_state(LATEX).bulged
    short, long = bubble_of_length(SIZE, LATEX, 0.2), bubble_of_length(SIZE, LATEX, 1.2)
    assert long.rest_length - short.rest_length == pytest.approx(1.0 / bulged.b)
    assert long.volume - short.volume == pytest.approx(math.pi * (bulged.a * SIZE.radius) ** 2)
    assert long.diameter == pytest.approx(2.0 * bulged.a * SIZE.radius, rel=5e-4)


def test_shapes_scale_with_the_radius_of_the_tube():
    wide = SIZE.with_overrides(radius=2.0 * SIZE.radius)
    shape, doubled = bubble_of_length(SIZE, LATEX, 0.05), bubble_of_length(wide, LATEX, 0.10)
    assert doubled.rest_length == pytest.approx(2.0 * shape.rest_length)
    assert doubled.volume == pytest.approx(8.0 * shape.volume)


@pytest.mark.parametrize("name", ["ogden-treloar", "gent"])
def test_other_rubbers_with_a_bulged_phase_hold_bubbles_too(name):
    assert twist_cost(SIZE, rubber_named(name)) == pytest.approx(9.2 * MM, rel=0.02)


def test_without_softening_a_pinched_bubble_bleeds_away():
    with pytest.raises(ValueError, match="needs softening"):
        bubble_of_length(SIZE, LATEX.without_softening(), 0.05)


@pytest.mark.parametrize("wrong", [0.0, -1.0, math.nan, math.inf])
def test_an_impossible_length_is_refused(wrong):
    with pytest.raises(ValueError, match="positive length"):
        bubble_of_length(SIZE, LATEX, wrong)
    with pytest.raises(ValueError, match="positive rest length"):
        bubble_of_rest_length(SIZE, LATEX, wrong)
