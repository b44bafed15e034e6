"""A finger that presses on a bubble of latex dents it, as deep or as hard as it is told."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

RECIPE = """\
format: 1
name: dented
units: cm
balloons: {main: {size: 260, length: 20, tail: 6}}
steps:
  - bubbles: {belly: 9}
  - press: {bubble: belly, HOW}
  - rest: tail
"""
ALONG = np.array([0.0, 0.0, -1.0])


class Pressed:
    """The bubble in every frame from before the finger comes until it has gone."""

    def __init__(self, how, bubbles="belly: 9"):
        planned = plan(Recipe.parse(RECIPE.replace("HOW", how).replace("belly: 9", bubbles)))
        self.simulation = simulate_many([planned], device="cpu")
        scene = self.simulation.model.scene
        names = [bubble.name for bubble in planned.bubbles]
        self.mine = scene.vertex_segment.numpy() == self.simulation.model.layout.bubbles[names.index("belly")]
        self.shapes, self.pressures, self.forces = [], [], []
        self.only_mine = True
        before = None
        for (frame,) in self.simulation.frames():
            points = frame.points[0].astype(np.float64)
            if not frame.doing.startswith("press"):
                if self.shapes:
                    break
                before = points, float(frame.pressure[0])
                continue
            if not self.shapes:
                self._take(*before)
            self._take(points, float(frame.pressure[0]))

    def _take(self, points, pressure):
        scene = self.simulation.model.scene
        self.shapes.append(points[self.mine])
        self.pressures.append(pressure)
        self.only_mine = self.only_mine and not scene.finger_push.numpy()[~self.mine].any()
        push = scene.finger_push.numpy() @ ALONG * scene.mass.numpy() / scene.settings.dt
        self.forces.append((push[push > 0.0].sum(), -push[push < 0.0].sum()))

    @property
    def held(self):
        """Number of a frame in which the finger has long been all the way in."""
        return 15

    def turned(self, frame):
        """Angle by which the bubble has turned, in degrees."""
        first, now = (points - points.mean(axis=0) for points in (self.shapes[0], self.shapes[frame]))
        left, _, right = np.linalg.svd(first.T @ now)
        turn = right.T @ np.diag([1.0, 1.0, np.linalg.det(right.T @ left.T)]) @ left.T
        return float(np.degrees(np.arccos(min(0.5 * (np.trace(turn) - 1.0), 1.0))))


@pytest.fixture(scope="module")
def deep():
    return Pressed("depth: 2")


@pytest.fixture(scope="module")
def hard():
    return Pressed('force: "4 N"')


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
    pressed = Pressed(f"at: {at}, depth: 1", bubbles="short: 2, belly: 9, small: 2")
    assert pressed.forces[pressed.held][0] > 1.0
    assert pressed.only_mine
