"""Roots of many functions at once."""

import numpy as np
import pytest

from balloon_usd.balloon.roots import root

POWERS = np.array([0.3, 1.0, 2.0, 5.08, 9.0])


def test_roots_are_found_to_the_last_digits_in_a_fifth_of_the_halvings():
    calls = []

    def excess(x):
        calls.append(x)
        return 2.0 - x**POWERS

    found = root(excess, np.ones(5), np.full(5, 16.0))
    assert found == pytest.approx(2.0 ** (1.0 / POWERS), rel=1e-14)
    assert len(calls) <= 16


def test_a_root_is_the_same_alone_as_among_others():
    together = root(lambda x: 2.0 - x**POWERS, np.ones(5), np.full(5, 16.0))
    alone = [root(lambda x, power=power: 2.0 - x**power, np.ones(1), np.full(1, 16.0))[0] for power in POWERS]
    assert together.tolist() == alone


def test_steep_steps_and_kinks_are_found_by_halving():
    place = np.array([1.25, 7.5, 15.999])
    assert root(lambda x: np.where(x < place, 1.0, -1e9), 1.0, np.full(3, 16.0)) == pytest.approx(place)


def test_what_is_no_number_lies_beyond_the_root():
    with np.errstate(invalid="ignore"):
        found = root(lambda x: np.where(x < 3.0, 2.0 - x, np.nan), np.zeros(1), np.full(1, 16.0))
    assert found == pytest.approx([2.0])


def test_without_a_change_of_sign_the_nearer_end_is_returned():
    shift = np.array([-100.0, 100.0])
    assert root(lambda x: shift - x, np.zeros(2), np.ones(2)).tolist() == [0.0, 1.0]
