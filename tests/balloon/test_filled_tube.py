"""Tubes blown up to their tip, against the quadrature of their meridian."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.bubble_quadrature import bubble_at_stretch
from balloon_usd.balloon.bubble_shape import pinch_volume, tube_volume_per_rest_length
from balloon_usd.balloon.filled_tube import filled_state, state_at_pressure
from balloon_usd.balloon.rubber import UnloadedRubber, rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import closed_tube_state, maxwell_state

SIZE, LATEX = size_named("260"), rubber_named("ogden")


def exact(a, harder):
    """Unstressed length (m), gas (m3) and pressure p* (Pa) of a bubble of that hoop stretch in its middle,
    whose pressure is so many times that of a long tube.
    """
    tube = closed_tube_state(LATEX, a)
    law = UnloadedRubber(LATEX, float(LATEX.energy(tube.a, tube.b)))
    pressure = np.array([harder * tube.p_star])
    rest, _, volume = bubble_at_stretch(law, pressure, np.array([a]), 1.0005 * a)[:, 0]
    return rest * SIZE.radius, volume * SIZE.radius**3, float(pressure[0])


@pytest.mark.parametrize(
    ("a", "stretch", "pressure"), [(6.6, 0.01, 0.065), (7.5, 0.01, 0.02), (9.0, 0.03, 0.07)]
)
@pytest.mark.parametrize("harder", [1.02, 1.1, 1.4, 2.5])
def test_it_is_as_hard_as_the_quadrature_says(a, harder, stretch, pressure):
    rest, volume, p_star = exact(a, harder)
    state = filled_state(SIZE, LATEX, rest, volume)
    assert state.a == pytest.approx(a, rel=stretch)
    assert state.p_star == pytest.approx(p_star, rel=pressure)


def test_a_tube_hardens_from_where_its_tail_is_used_up():
    for rest in (0.02, 0.05, 0.5):
        full = tube_volume_per_rest_length(SIZE, LATEX) * rest - 0.5 * pinch_volume(SIZE, LATEX)
        assert filled_state(SIZE, LATEX, rest, full - 1e-12) is None
        states = [
            filled_state(SIZE, LATEX, rest, full + gas * 1e-6) for gas in (0.01, 1.0, 20.0, 38.0, 39.0, 80.0)
        ]
        stretches = [state.a for state in states]
        assert stretches == sorted(stretches)
        assert stretches[0] == pytest.approx(maxwell_state(LATEX).bulged.a, rel=1e-4)


def test_states_of_a_long_tube_are_those_of_theory():
    for a in (5.7, 6.3, 8.0, 13.0):
        exactly = closed_tube_state(LATEX, a)
        state = state_at_pressure(LATEX, exactly.p_star)
        assert (state.a, state.b) == pytest.approx((exactly.a, exactly.b), rel=1e-5)
