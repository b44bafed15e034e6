"""Chains that have curled up unfold: bubbles go past each other, not through."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.solver.motions.opening import opening_path
from balloon_usd.solver.motions.unfolding import clearance, unfolded

WIDTH = 0.05
"""Of bubbles, m."""
LENGTH = 0.03
"""Of each, m."""
COUNT = 24
SIDES = np.array([(k, k + 1) for k in range(COUNT - 1)])


def coil() -> np.ndarray:
    """Return the joints of a chain that has curled up to a coil of three turns."""
    around, rise = 8, 1.1 * WIDTH
    radius = 0.5 * LENGTH / math.sin(math.pi / 8)
    angle = 2.0 * math.pi * np.arange(COUNT) / around
    places = np.stack(
        [radius * np.cos(angle), radius * np.sin(angle), rise * np.arange(COUNT) / around], axis=1
    )
    return places - places[-1]


def ring() -> np.ndarray:
    """Return its joints as a ring that is not yet closed, on its side."""
    radius = 0.5 * LENGTH / math.sin(math.pi / COUNT)
    angle = 2.0 * math.pi * np.arange(COUNT) / COUNT
    places = np.stack([radius * np.cos(angle), np.zeros(COUNT), radius * np.sin(angle)], axis=1)
    return places - places[-1]


def distances(places: np.ndarray) -> np.ndarray:
    return np.linalg.norm(places[:, None] - places, axis=2)


def test_bubbles_of_a_chain_that_has_curled_up_go_past_each_other_on_its_way_to_a_ring():
    began, shape = coil(), ring()
    straight = began + np.linspace(0.0, 1.0, 13)[:, None, None] * (shape - began)
    assert clearance(straight, shape, SIDES) < 0.1 * WIDTH
    path = opening_path(began, shape, SIDES.tolist(), None, WIDTH)
    ends = min(clearance(path[[k, k]], shape, SIDES) for k in (0, -1))
    assert clearance(path, shape, SIDES) > 0.9 * ends
    assert distances(path[-1]) == pytest.approx(distances(shape), abs=0.001)


def test_joints_come_hardly_nearer_to_each_other_than_they_are_at_the_begin_or_the_end():
    began, shape = coil(), ring()
    nearest = np.minimum(distances(began), distances(shape))
    for pose in unfolded(began, shape, WIDTH, 13)[:-1]:
        assert (distances(pose) > 0.7 * nearest - 1e-9).all()


def test_what_unfolds_goes_evenly():
    path = opening_path(coil(), ring(), SIDES.tolist(), None, WIDTH)
    ways = np.linalg.norm(np.diff(path, axis=0), axis=2).max(axis=1)
    assert ways.max() < 2.0 * ways.mean()


def test_a_wide_way_stays_straight():
    began = np.array([(0.0, 0, 0), (0.2, 0, 0), (0.4, 0, 0), (0.6, 0, 0)])
    shape = np.array([(0.0, 0, 0), (0.2, 0, 0), (0.3, 0.17, 0), (0.2, 0.34, 0)])
    path = opening_path(began, shape, [], None, WIDTH)
    shares = np.linspace(0.0, 1.0, len(path))[:, None, None]
    assert path == pytest.approx(path[0] + shares * (path[-1] - path[0]))


def test_the_clearance_of_two_bubbles_is_that_of_their_middles_where_they_pass():
    sides = np.array([(0, 1), (2, 3)])
    shape = np.array([(-1.0, 0, 0), (1.0, 0, 0), (0, -1.0, 0.3), (0, 1.0, 0.3)])
    passing = np.array([shape, shape - [(0, 0, 0), (0, 0, 0), (0, 0, 0.6), (0, 0, 0.6)]])
    assert clearance(passing[:1], shape, sides) == pytest.approx(0.3)
    assert clearance(passing, shape, sides) == pytest.approx(0.0, abs=1e-9)


def test_bubbles_that_share_a_joint_are_in_nobodys_way():
    shape = np.array([(0.0, 0, 0), (1.0, 0, 0), (1.0, 1.0, 0)])
    assert math.isinf(clearance(shape[None], shape, np.array([(0, 1), (1, 2)])))
