"""Balls, the bubbles too short to be stable at the pressure of the tube, against the membrane quadrature."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.bubble_quadrature import bubble_at_stretch
from balloon_usd.balloon.bubble_shape import (
    bubble_of_length,
    shortest_stable_bubble,
    smallest_ball,
    softest_ball,
)
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import inflated_rubber, maxwell_state

SIZE, LATEX = size_named("260"), rubber_named("ogden")
MM, ML = 1e-3, 1e-6
RUBBERS = ["ogden", "ogden-treloar", "gent"]


def ball(length, rubber=LATEX):
    return bubble_of_length(SIZE, rubber, length * MM)


@pytest.mark.parametrize(
    ("length", "rest_length", "diameter", "volume", "pressure"),
    [(20.0, 13.05, 24.5, 6.70, 1.0), (15.0, 10.79, 19.6, 3.22, 1.333), (10.0, 9.19, 13.6, 1.05, 2.0)],
)
def test_a_ball_of_a_260_takes_so_much_rubber_and_gas(length, rest_length, diameter, volume, pressure):
    found = ball(length)
    assert found.rest_length / MM == pytest.approx(rest_length, abs=0.01)
    assert found.diameter / MM == pytest.approx(diameter, abs=0.05)
    assert found.volume / ML == pytest.approx(volume, abs=0.01)
    assert found.pressure == pytest.approx(pressure, rel=2e-3)


@pytest.mark.parametrize("name", RUBBERS)
@pytest.mark.parametrize("share", [0.49, 0.6, 0.7, 0.85, 0.99, 1.01, 1.04])
def test_every_ball_is_a_membrane_in_balance_at_its_pressure(name, share):
    rubber = rubber_named(name)
    tube, law = maxwell_state(rubber), inflated_rubber(rubber)
    found = bubble_of_length(SIZE, rubber, share * softest_ball(SIZE, rubber).length)
    widest = np.array([0.5 * found.diameter / SIZE.radius])
    exact = bubble_at_stretch(law, found.pressure * tube.p_star, widest, tube.bulged.a)
    rest_length, length, volume = exact[:, 0]
    assert rest_length * SIZE.radius == pytest.approx(found.rest_length, rel=2e-3)
    assert length * SIZE.radius == pytest.approx(found.length, rel=2e-3)
    assert volume * SIZE.radius**3 == pytest.approx(found.volume, rel=2e-3)


@pytest.mark.parametrize("name", RUBBERS)
def test_a_shorter_ball_is_narrower_harder_and_holds_less_and_nothing_jumps(name):
    lengths = np.arange(5.0, 26.0, 0.1)
    found = [ball(length, rubber_named(name)) for length in lengths]
    for of in ("volume", "diameter"):
        values = np.array([getattr(each, of) for each in found])
        step = np.diff(values)
        assert step.min() > 0.0
        assert step.max() < 0.1 * values.max()
    assert np.diff([each.pressure for each in found]).max() <= 0.0
    assert np.abs(np.diff([each.rest_length for each in found])).max() < 0.3 * MM


def test_balls_stay_nearly_round():
    shapes = [ball(length) for length in np.arange(10.0, 24.0, 0.5)]
    assert all(0.7 < each.length / each.diameter < 0.85 for each in shapes)


def test_balls_begin_where_stable_bubbles_end():
    shortest = shortest_stable_bubble(SIZE, LATEX)
    below = bubble_of_length(SIZE, LATEX, shortest.length * (1.0 - 1e-9))
    assert below.rest_length == pytest.approx(shortest.rest_length, rel=1e-4)
    assert below.diameter == pytest.approx(shortest.diameter, rel=1e-4)
    assert below.volume == pytest.approx(shortest.volume, rel=1e-4)


def test_the_softest_ball_lies_at_the_pressure_of_the_tube_and_the_smallest_at_twice_that():
    assert softest_ball(SIZE, LATEX).length / MM == pytest.approx(20.0, abs=0.05)
    assert softest_ball(SIZE, LATEX).pressure == pytest.approx(1.0)
    assert smallest_ball(SIZE, LATEX).length / MM == pytest.approx(10.0, abs=0.05)
    assert smallest_ball(SIZE, LATEX).pressure == pytest.approx(2.0)


def test_what_is_smaller_than_any_that_is_solved_is_a_copy():
    small, tiny = ball(4.0), ball(2.0)
    assert tiny.rest_length == pytest.approx(0.5 * small.rest_length)
    assert tiny.diameter == pytest.approx(0.5 * small.diameter)
    assert tiny.volume == pytest.approx(0.125 * small.volume)
