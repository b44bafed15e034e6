"""Walls that would go through each other go on as one, and those that have are led apart."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.solver.kernels.physics.keeping_apart import MOST_PUT_BACK, WATCHED_FRAMES
from balloon_usd.solver.kernels.physics.motion import LEADING_SPEED, SLOW
from balloon_usd.solver.simulation import simulate_many
from tests.solver.locked_pair import locked_pair

PUSHED = 0.003
"""How far one bubble is pushed into the other, m."""
SLID = 0.001
"""How far it is moved along the other besides, m."""
FRAME = 1.0 / 12.0
"""Time of a frame of the pair, s."""


class Pair:
    """A locked pair at its end, whose walls only the test moves, and what keeps them apart."""

    def __init__(self) -> None:
        planned = locked_pair()
        simulation = simulate_many([planned], detail="draft", device="cpu")
        assert all(frames for frames in simulation.frames())
        # Its hands own the memory of some arrays.
        self._model = simulation.model
        self.scene, self.untangling = self._model.scene, self._model.stepper._untangling
        self.scene.touching.assign(np.ones(len(self.scene.bodies), dtype=np.int32))
        self.scene.leading.fill_(LEADING_SPEED)
        self.scene.floating.zero_()
        self._counter = CrossingCounter(walls_of(planned, simulation.meshes[0]), 100)
        self.made = self.scene.x.numpy().copy()

    def start(self) -> None:
        """Let it be as it was made, at rest, its walls apart."""
        self.scene.x.assign(self.made)
        self.scene.v.zero_()
        self.untangling.leave()

    def of(self, bubble: int) -> np.ndarray:
        """Whether each vertex is of a bubble, by its place on the balloon, but not of its necks."""
        inside: np.ndarray = self.scene.vertex_segment.numpy() == self.scene.bubbles_of(0)[bubble]
        inside[self.scene.quads.numpy()[self.scene.quad_neck.numpy() >= 0]] = False
        return inside

    def crossings(self) -> int:
        """How many there are in no neck."""
        return self._counter.count([self.scene.x.numpy()]).count

    def push(self) -> np.ndarray:
        """Push one bubble into the other; how far, m."""
        left, right = self.of(1), self.of(2)
        way = self.made[right].mean(axis=0) - self.made[left].mean(axis=0)
        pushed = self.made.copy()
        pushed[left] += PUSHED * way / np.linalg.norm(way)
        self.scene.x.assign(pushed)
        assert self.crossings() > 30
        return pushed

    def watch_soon(self) -> None:
        """Let it be looked at between two searches."""
        for array in (self.scene.watched, self.scene.any_watched):
            array.fill_(WATCHED_FRAMES)
        self.scene.safe_seconds.fill_(self.untangling._between_searches)

    def block(self) -> np.ndarray:
        """Let one bubble be in the other already, and all go on as one, so that nothing keeps them apart; where
        they were, m.
        """
        pushed = self.push()
        self.untangling.leave()
        self.scene.x.assign(pushed + np.float32(0.05))
        self.watch_soon()
        return pushed

    def closed(self) -> np.ndarray:
        """Whether each vertex is of a closed ring."""
        joint = self.scene.vertex_joint.numpy()
        parts = self.scene.joint_parts.numpy()[joint] == 1
        found: np.ndarray = (joint >= 0) & parts & (self.scene.radius_to.numpy()[joint] > 0.0)
        assert found.any()
        return found


@pytest.fixture(scope="module")
def whole_pair():
    return Pair()


@pytest.fixture
def pair(whole_pair):
    whole_pair.start()
    return whole_pair


def test_a_bubble_that_would_go_into_another_takes_it_along(pair):
    pushed = pair.push()
    pair.untangling.end_frame()
    x, v = pair.scene.x.numpy(), pair.scene.v.numpy()
    assert pair.crossings() == 0
    held = np.linalg.norm(x - pushed, axis=1) > 0.0
    assert held[pair.of(1)].any()
    assert held[pair.of(2)].any()
    # Slower than it was pushed, and no faster than that moved it.
    assert np.linalg.norm(x - pair.made, axis=1).max() <= 1.001 * PUSHED
    assert np.abs(v[held] - (x - pair.made)[held] / FRAME).max() < 1e-3
    assert not v[~held].any()


def test_walls_that_cross_already_are_led_apart(pair):
    pushed = pair.push()
    pair.untangling.leave()
    pair.untangling.end_frame()
    assert pair.crossings() == 0
    far = np.linalg.norm(pair.scene.x.numpy() - pushed, axis=1)
    assert far.max() < 2.0 * PUSHED
    assert (far == 0.0).mean() > 0.5
    assert pair.scene.segment_shift.numpy().max() == pytest.approx(far.max(), rel=1e-3)


def test_walls_that_touch_slide_on_each_other(pair):
    left, right = pair.of(1), pair.of(2)
    way = pair.made[right].mean(axis=0) - pair.made[left].mean(axis=0)
    sideways = np.cross(way, [0.0, 0.0, 1.0])
    sideways /= np.linalg.norm(sideways)
    pushed = pair.push()
    pushed[left] += (SLID * sideways).astype(np.float32)
    pair.scene.x.assign(pushed)
    pair.untangling.end_frame()
    x = pair.scene.x.numpy()
    assert pair.crossings() == 0
    held = np.linalg.norm(x - pushed, axis=1) > 0.0
    slid, taken_along = (((x - pair.made)[held & bubble] @ sideways).mean() for bubble in (left, right))
    # Stuck to each other both would go half as far; free, one would go all the way, and the other none.
    assert slid > 0.6 * SLID
    assert slid - taken_along > 0.4 * SLID


@pytest.mark.parametrize("crossing_already", [False, True])
def test_joints_stay_where_they_are(pair, crossing_already):
    pushed = pair.push()
    if crossing_already:
        pair.untangling.leave()
    pair.untangling.end_frame()
    assert np.array_equal(pair.scene.x.numpy()[pair.closed()], pushed[pair.closed()])


def test_walls_that_cross_nowhere_stay_where_they_are_bit_by_bit():
    model = simulate_many([locked_pair()], detail="draft", device="cpu").model
    scene, untangling = model.scene, model.stepper._untangling
    scene.touching.assign(np.ones(len(scene.bodies), dtype=np.int32))
    flat = scene.x.numpy().copy()
    untangling.end_frame()
    assert np.array_equal(scene.x.numpy(), flat)
    assert not scene.watched.numpy().any()


def test_walls_that_would_cross_are_slow_and_watched_for_a_while(pair):
    pair.push()
    pair.untangling.end_frame()
    slowness = pair.scene.slowness.numpy()
    assert slowness.max() == pytest.approx(1.0 / SLOW)
    assert (slowness == 0.0).mean() > 0.3
    assert pair.scene.any_watched.numpy()[0] > 0
    for _ in range(WATCHED_FRAMES):
        pair.untangling.watch()
        pair.untangling.end_frame()
    assert pair.scene.any_watched.numpy()[0] == 0
    assert pair.scene.slowness.numpy().max() < 0.5 / SLOW


def test_what_keeps_walls_apart_gives_the_same_bits_again(pair):
    found = []
    for _ in range(2):
        pair.start()
        pair.push()
        pair.untangling.end_frame()
        found.append(pair.scene.x.numpy().copy())
    assert np.array_equal(*found)


def test_what_nothing_keeps_apart_is_put_back_at_rest_and_led_apart_there(pair):
    pushed = pair.block()
    pair.scene.v.fill_(1.0)
    pair.untangling.watch()
    assert pair.scene.put_back.numpy() == [1]
    assert not pair.scene.v.numpy().any()
    assert pair.crossings() == 0
    assert np.linalg.norm(pair.scene.x.numpy() - pushed, axis=1).max() < 2.0 * PUSHED


def test_bubbles_that_nothing_keeps_apart_are_told_as_jammed_and_no_others(pair):
    pair.block()
    pair.untangling.begin_frame()
    pair.untangling.watch()
    jammed = np.flatnonzero(pair.scene.segment_jammed.numpy())
    assert jammed.tolist() == pair.scene.bubbles_of(0)[[1, 2]].tolist()
    pair.untangling.begin_frame()
    assert not pair.scene.segment_jammed.numpy().any()


def test_bubbles_that_are_kept_apart_are_not_jammed(pair):
    pair.push()
    pair.untangling.begin_frame()
    pair.untangling.end_frame()
    assert pair.crossings() == 0
    assert not pair.scene.segment_jammed.numpy().any()


def test_what_is_put_back_too_often_in_a_row_goes_on(pair):
    pushed = pair.block()
    pair.scene.put_back.fill_(MOST_PUT_BACK)
    pair.untangling.watch()
    assert pair.scene.put_back.numpy() == [0]
    assert np.linalg.norm(pair.scene.x.numpy() - pushed, axis=1).max() > 0.05
