"""Walls that have gone through each other are led back out."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.solver.hands import LEADING_SPEED
from balloon_usd.solver.simulation import simulate_many
from tests.solver.locked_pair import locked_pair

PUSHED = 0.003
"""How far one bubble is pushed into the other, m."""
STEPS = 24
"""Frames in which they are led apart: 2 s at 12 frames/s."""


class Pair:
    """A locked pair at its end, whose walls only untangling moves."""

    def __init__(self) -> None:
        planned = locked_pair()
        simulation = simulate_many([planned], detail="draft", device="cpu")
        assert all(frames for frames in simulation.frames())
        # Its hands own the memory of some arrays.
        self._model = simulation.model
        self.scene, self._stepper = self._model.scene, self._model.stepper
        self.scene.touching.assign(np.ones(len(self.scene.bodies), dtype=np.int32))
        # The speed fades in what lies.
        self.scene.leading.fill_(LEADING_SPEED)
        self._walls = walls_of(planned, simulation.meshes[0])
        self._counter = CrossingCounter(self._walls, 1)
        self.made = self.scene.x.numpy().copy()

    def of(self, bubble: int) -> np.ndarray:
        """Whether each vertex is of a bubble, by its place on the balloon."""
        return self.scene.vertex_segment.numpy() == self.scene.bubbles_of(0)[bubble]

    def crossings(self) -> int:
        """How many there are in no neck."""
        return self._counter.count([self.scene.x.numpy()]).count

    def pierced(self) -> set[int]:
        """Vertices of all edges and faces that pierce each other, in necks too."""
        found = self._counter._pierced(self.scene.x.numpy())
        return {*found.edges.ravel().tolist(), *self._walls.triangles[found.triangles].ravel().tolist()}

    def push(self) -> None:
        """Push one bubble, but for its necks, into the other."""
        left, right = self.of(1), self.of(2)
        left[self.scene.quads.numpy()[self.scene.quad_neck.numpy() >= 0]] = False
        way = self.made[right].mean(axis=0) - self.made[left].mean(axis=0)
        pushed = self.made.copy()
        pushed[left] += PUSHED * way / np.linalg.norm(way)
        self.scene.x.assign(pushed)

    def untangle(self) -> None:
        self._stepper._search.measure_quads()
        self._stepper._untangling.step()


@pytest.fixture(scope="module")
def whole_pair():
    return Pair()


@pytest.fixture
def pair(whole_pair):
    whole_pair.scene.x.assign(whole_pair.made)
    return whole_pair


def test_a_bubble_that_was_pushed_into_another_is_led_out_again(pair):
    pair.push()
    assert pair.crossings() > 30
    for _ in range(STEPS):
        pair.untangle()
    assert pair.crossings() == 0


def test_only_what_crosses_is_moved_and_no_farther_than_a_step(pair):
    pair.push()
    before, pierced = pair.scene.x.numpy().copy(), pair.pierced()
    pair.untangle()
    far = np.linalg.norm(pair.scene.x.numpy() - before, axis=1)
    moved = set(np.flatnonzero(far > 0.0).tolist())
    assert len(moved) > 30
    assert moved <= pierced
    assert far.max() <= 1.001 * LEADING_SPEED / 12


def test_walls_that_cross_nowhere_stay_where_they_are_bit_by_bit(pair):
    model = simulate_many([locked_pair()], detail="draft", device="cpu").model
    scene, stepper = model.scene, model.stepper
    scene.touching.assign(np.ones(len(scene.bodies), dtype=np.int32))
    flat = scene.x.numpy().copy()
    stepper._search.measure_quads()
    stepper._untangling.step()
    assert np.array_equal(scene.x.numpy(), flat)
