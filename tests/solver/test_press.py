"""A finger that presses on a bubble of latex dents it, as deep or as hard as it is told."""

from __future__ import annotations

import numpy as np
import pytest

from tests.solver.pressed import Pressed


@pytest.fixture(scope="module")
def deep():
    return Pressed("press: {bubble: belly, depth: 2}")


@pytest.fixture(scope="module")
def hard():
    return Pressed('press: {bubble: belly, force: "4 N"}')


def test_a_finger_dents_a_bubble_as_deep_as_it_is_told_and_does_not_roll_it_away(deep):
    first, now = deep.shapes[0], deep.shapes[deep.held]
    sunk = first[:, 2] - now[:, 2]
    assert 0.016 < sunk.max() < 0.021
    assert np.linalg.norm(now.mean(axis=0) - first.mean(axis=0)) < 0.005
    assert max(deep.turned(frame) for frame in range(deep.held + 1)) < 3.0
    assert deep.pressures[deep.held] > 1.1 * deep.pressures[0]


def test_the_palm_of_the_other_hand_bears_most_of_what_the_finger_presses(deep):
    finger, palm = deep.forces[deep.held]
    assert finger > 5.0
    # The rest hangs on the hands at both ends.
    assert 0.6 * finger < palm < finger


def test_a_finger_presses_as_hard_as_it_is_told(hard):
    for frame in range(hard.held - 2, hard.held + 1):
        assert hard.forces[frame][0] == pytest.approx(4.0, rel=0.03)


def test_a_bubble_is_round_again_once_the_finger_has_gone(deep):
    first, last = deep.shapes[0], deep.shapes[-1]
    size = [np.ptp(points, axis=0) for points in (first, last)]
    assert size[1] == pytest.approx(size[0], abs=1.5e-3)
    assert deep.pressures[-1] == pytest.approx(deep.pressures[0], rel=0.05)


@pytest.mark.parametrize("at", ["0.001", "0.1", "8.9", "8.9999"])
def test_a_finger_close_to_a_joint_presses_on_the_bubble(at):
    pressed = Pressed(
        f"press: {{bubble: belly, at: {at}, depth: 1}}", bubbles="{short: 2, belly: 9, small: 2}"
    )
    assert pressed.forces[pressed.held][0] > 1.0
    assert pressed.only_mine
