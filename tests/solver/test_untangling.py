"""Walls that have gone through each other are led back out, and shown where none cross."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.solver.hands import LEADING_SPEED
from balloon_usd.solver.kernels.physics.motion import LYING_MODE
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
        """How many there are in no neck where walls are."""
        return self._counter.count([self.scene.x.numpy()]).count

    def shown(self) -> int:
        """How many there are in no neck where walls are shown."""
        return self._counter.count([self.scene.x_shown.numpy()]).count

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
        """Show a frame, and lead walls as at the start of the next."""
        self._stepper._untangling.show()
        self._stepper._untangling.lead()


@pytest.fixture(scope="module")
def whole_pair():
    return Pair()


@pytest.fixture
def pair(whole_pair):
    whole_pair.scene.x.assign(whole_pair.made)
    whole_pair.scene.v.zero_()
    whole_pair.scene.shown_shift.zero_()
    whole_pair.scene.shifted.zero_()
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
    # An edge is taken to be a hundredth longer than it is.
    assert len(moved - pierced) <= 0.02 * len(moved)
    assert far.max() <= 1.001 * LEADING_SPEED / 12


def test_walls_that_cross_nowhere_stay_where_they_are_bit_by_bit(pair):
    model = simulate_many([locked_pair()], detail="draft", device="cpu").model
    scene, stepper = model.scene, model.stepper
    scene.touching.assign(np.ones(len(scene.bodies), dtype=np.int32))
    flat = scene.x.numpy().copy()
    stepper._untangling.show()
    stepper._untangling.lead()
    assert np.array_equal(scene.x.numpy(), flat)
    assert np.array_equal(scene.x_shown.numpy(), flat)


def test_bubbles_that_cross_are_shown_apart_in_the_same_frame(pair):
    pair.push()
    pushed = pair.crossings()
    pair.untangle()
    assert pushed > 30
    assert pair.shown() == 0
    # All else is where it is.
    far = np.linalg.norm(pair.scene.x_shown.numpy() - pair.scene.x.numpy(), axis=1)
    assert far.max() < 2.0 * PUSHED
    assert (far == 0.0).mean() > 0.5


def test_joints_are_shown_where_they_are(pair):
    pair.push()
    pair.untangle()
    shift = pair.scene.x_shown.numpy() - pair.scene.x.numpy()
    closed = pair.scene.vertex_joint.numpy() >= 0
    closed &= pair.scene.joint_parts.numpy()[pair.scene.vertex_joint.numpy()] == 1
    closed &= pair.scene.radius_to.numpy()[pair.scene.vertex_joint.numpy()] > 0.0
    assert closed.any()
    assert not shift[closed].any()


def test_what_no_more_crosses_comes_back_to_where_it_is_by_and_by(pair):
    pair.push()
    pair.untangle()
    pair.scene.x.assign(pair.made)
    pair.scene.touching.assign(np.ones(len(pair.scene.bodies), dtype=np.int32))
    far = []
    for _ in range(STEPS):
        pair.untangle()
        assert pair.shown() == 0
        far.append(float(np.linalg.norm(pair.scene.x_shown.numpy() - pair.made, axis=1).max()))
    assert far == sorted(far, reverse=True)
    assert far[-1] < 0.1 * far[0]


def test_what_lies_is_shown_as_it_was(pair):
    pair.push()
    pair.scene.leading.zero_()
    pair.untangle()
    before = pair.scene.x_shown.numpy().copy()
    pair.scene.touching.assign(np.full(len(pair.scene.bodies), LYING_MODE, dtype=np.int32))
    pair.untangle()
    # But for rounding.
    assert np.abs(pair.scene.x_shown.numpy() - before).max() < 1e-7
    pair.scene.touching.assign(np.ones(len(pair.scene.bodies), dtype=np.int32))
    pair.scene.leading.fill_(LEADING_SPEED)
