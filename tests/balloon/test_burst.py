"""A wall bursts where its energy, weighted as by its weakest places, is that of a 260 stretched to seven."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.burst import SCATTER, WHOLE, burst_energy, burst_load, least_burst_stretch
from balloon_usd.balloon.rubber import BURST_STRETCH, RUBBERS, rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import closed_tube_state

LATEX = rubber_named()


def energy_at(a):
    state = closed_tube_state(LATEX, a)
    return float(LATEX.energy(state.a, state.b))


def test_a_260_stretched_alike_all_over_bursts_at_seven():
    size = size_named("260")
    rubber = 2.0 * np.pi * size.radius * size.length * size.thickness
    assert rubber == pytest.approx(WHOLE, rel=0.01)
    assert burst_load(LATEX, [WHOLE], [energy_at(BURST_STRETCH)]) == pytest.approx(1.0, rel=1e-3)
    assert burst_load(LATEX, [WHOLE], [energy_at(5.66)]) < 0.5


def test_its_energy_is_that_of_a_strip_at_the_elongation_which_the_standard_asks_for():
    assert LATEX.energy(8.3, 8.3**-0.5) < burst_energy(LATEX) < LATEX.energy(8.5, 8.5**-0.5)


def test_a_crease_bears_more_than_a_whole_tube():
    crease = 2.5 * energy_at(5.66)
    assert crease > burst_energy(LATEX)
    assert burst_load(LATEX, [0.02 * WHOLE], [crease]) < 1.0 < burst_load(LATEX, [WHOLE], [crease])


def test_a_load_is_the_same_however_a_wall_is_cut_into_parts():
    energies = np.linspace(1e6, 3e7, 7)
    volumes = np.full(7, WHOLE / 7.0)
    halves = burst_load(LATEX, np.repeat(0.5 * volumes, 2), np.repeat(energies, 2))
    assert halves == pytest.approx(burst_load(LATEX, volumes, energies))


def test_half_of_the_rubber_bears_more():
    more = 2.0 ** (1.0 / SCATTER)
    assert burst_load(LATEX, [0.5 * WHOLE], [more * burst_energy(LATEX)]) == pytest.approx(1.0)


@pytest.mark.parametrize("rubber", RUBBERS, ids=lambda rubber: rubber.name)
def test_a_wall_of_any_rubber_has_its_burst_energy_at_a_smaller_stretch_if_stretched_both_ways(rubber):
    least = least_burst_stretch(rubber)
    assert 5.0 < least < BURST_STRETCH
    assert rubber.energy(least, least) == pytest.approx(burst_energy(rubber), rel=1e-6)
