"""The mirror of a figure, and how its places are led to where it is symmetric."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.mirroring import Mirror, ways_to_symmetry
from balloon_usd.solver.rotations import rotation

LEFT = np.array([[0.0, 0.00, 0.0], [0.01, -0.04, 0.0], [0.0, -0.08, 0.0]])
"""Along a limb on the left, m."""
NOSE = np.array([[-0.03, 0.0, 0.0], [-0.06, 0.0, 0.0], [-0.09, 0.0, 0.01]])
"""Along what lies between, m."""
ACROSS = np.array([[0.05, -0.02, 0.0], [0.05, 0.0, 0.01], [0.05, 0.02, 0.0]])
"""Along what lies across the mirror, m."""
OTHER = np.array([1.0, -1.0, 1.0])
A, B, C, D = (np.arange(3) + 3 * k for k in range(4))
TURN, AT = rotation(np.array([0.3, -0.5, 0.8])), np.array([0.2, 0.1, 0.4])


def figure(right: np.ndarray = OTHER * LEFT, nose: np.ndarray = NOSE) -> np.ndarray:
    """Places of a figure somewhere in space, (12, 3), m."""
    return np.concatenate([LEFT, right, nose, ACROSS]) @ TURN.T + AT


def ways(places: np.ndarray, near: float = 0.04) -> np.ndarray:
    """How far its places are led, (12, 3), m."""
    return ways_to_symmetry(places, [(A, B)], [C, D], near)


def off(places: np.ndarray) -> float:
    """How far a figure is from its mirror image, m."""
    mirror = Mirror.of_twins([(places[A], places[B])])
    pairs = [(A, B), (C, C), (D, D[::-1])]
    return max(float(mirror.misses(places[a], places[b]).max()) for a, b in pairs)


def test_a_figure_that_is_symmetric_stays_as_it_is():
    assert np.abs(ways(figure())).max() < 1e-12


def test_a_twin_that_leans_and_a_nose_that_looks_aside_are_led_into_symmetry():
    leans = (OTHER * LEFT) @ rotation(np.array([0.0, 0.15, 0.1])).T
    places = figure(leans, NOSE + [[0.0, 0.0, 0.0], [0.0, 0.005, 0.0], [0.0, 0.01, 0.0]])
    assert off(places) > 0.01
    after = places + ways(places)
    assert off(after + ways(after)) < 1e-4
    # Both sides go half of the way.
    assert np.abs(ways(places)[A]).max() == pytest.approx(np.abs(ways(places)[B]).max(), rel=0.3)


def test_twins_may_run_either_way_along_each_others_image():
    places = figure((OTHER * LEFT)[::-1])
    assert np.abs(ways(places)).max() < 1e-12


def test_what_looks_far_aside_means_to_and_goes_with_what_is_beside_it():
    aside = NOSE @ rotation(np.array([0.0, 0.0, 1.2])).T
    places = figure((OTHER * LEFT) @ rotation(np.array([0.0, 0.15, 0.0])).T, aside)
    led = ways(places)
    beside = [*A, *B, *D]
    apart = np.linalg.norm(places[C][:, None] - places[beside], axis=2).min(axis=0)
    assert led[C] == pytest.approx(np.tile(led[beside][apart.argmin()], (3, 1)))
    assert np.abs(led[C]).max() < 0.01
