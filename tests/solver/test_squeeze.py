"""Two hands that squeeze a bubble of latex flat: its pressure rises, and they feel how firm it is."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.air import ATMOSPHERE
from tests.solver.pressed import Pressed


@pytest.fixture(scope="module")
def firm():
    return Pressed('squeeze: {bubble: belly, by: "40 %"}', held=20)


@pytest.fixture(scope="module")
def soft():
    return Pressed('squeeze: {bubble: belly, by: "40 %"}', bubbles='{belly: 9}\n    burp: "30 %"', held=20)


def heights(points):
    """Heights at which a bubble begins and ends, m: of the flattest tenth of its vertices on either side."""
    return np.quantile(points[:, 2], (0.02, 0.98))


def test_hands_come_as_near_to_each_other_as_they_are_told_and_yield_by_two_millimetres_each(firm):
    low, high = heights(firm.shapes[firm.held])
    told = 0.6 * np.ptp(heights(firm.shapes[0]))
    assert told < high - low < told + 4e-3


def test_a_squeezed_bubble_stays_where_it_is_and_does_not_roll(firm):
    first, now = firm.shapes[0].mean(axis=0), firm.shapes[firm.held].mean(axis=0)
    assert np.abs(now - first)[:2] == pytest.approx(0.0, abs=2e-3)
    assert firm.turned(firm.held) < 2.0


def test_both_hands_press_equally_hard(firm):
    one, other = firm.forces[firm.held]
    assert other == pytest.approx(one, rel=0.01)


def test_the_force_is_the_pressure_on_the_flat_part_of_the_wall(firm):
    points, pressure = firm.shapes[firm.held], firm.pressures[firm.held]
    low, _ = heights(points)
    long, wide = np.ptp(points[points[:, 2] < low + 1e-3], axis=0)[:2]
    # Between an ellipse and a rectangle.
    assert 0.25 * np.pi < firm.forces[firm.held][0] / (pressure * long * wide) < 1.02


def test_the_gas_of_a_squeezed_bubble_stays_in_it(firm):
    products = [(p + ATMOSPHERE) * v for p, v in zip(firm.pressures, firm.volumes, strict=True)]
    assert products == pytest.approx([products[0]] * len(products), rel=1e-4)


def test_a_soft_bubble_yields_more_easily_than_a_firm_one(soft, firm):
    assert soft.forces[soft.held][0] < 0.8 * firm.forces[firm.held][0]
    assert firm.pressures[firm.held] > 1.2 * firm.pressures[0]


def test_a_bubble_is_round_again_once_the_hands_have_gone(firm):
    assert np.ptp(firm.shapes[-1], axis=0) == pytest.approx(np.ptp(firm.shapes[0], axis=0), abs=1.5e-3)
    assert firm.only_mine
