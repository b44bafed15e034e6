"""Figures that hands have put aside stay where they are while hands work on others."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.kernels.physics.joints import GRIP_MODE, LEAD_MODE
from balloon_usd.solver.latex.put_aside import FAR, PutAside
from balloon_usd.solver.latex.spins import VertexSet
from balloon_usd.solver.sculpture import ComingFrame
from balloon_usd.solver.simulation import simulate_many

TWO = """
format: 1
name: two
units: cm
balloons:
  one: {size: 160, length: 12, tail: 4}
  other: {size: 160, length: 12, tail: 4}
steps:
  - bubbles: {a: 6}
    balloon: one
  - bubbles: {b: 6}
    balloon: other
  - lock: {joints: [a.end, b.end]}
"""


class Aside:
    """Two balloons, of which hands hold the second, and the first can be moved."""

    def __init__(self):
        simulation = simulate_many([plan(Recipe.parse(TWO))], device="cpu")
        self.sculpture = simulation.model.performers[0].sculpture
        self.hands = self.sculpture.hands
        self.aside = PutAside(self.sculpture, self.hands)
        scene = self.sculpture.scene
        self.joints = [np.arange(*scene.joint_start[body : body + 2]) for body in (0, 1)]
        self.middle = np.random.default_rng(3).uniform(0.0, 0.3, (len(self.hands.mode), 3)).astype(np.float32)
        self.time = 0.0
        self.hands.mode[self.joints[1][0]] = GRIP_MODE

    def look(self, drift, *, begun=True):
        """Look at both after the first has gone a way along x (m); return the joints on which hands are."""
        self.time += 0.1
        self.middle[self.joints[0], 0] += drift
        self.sculpture.frame = ComingFrame(self.time - 0.1, self.time, self.middle)
        self.aside.look(self.time, begun=begun)
        return [np.flatnonzero(self.hands.mode[joints]).tolist() for joints in self.joints]


@pytest.fixture
def two():
    return Aside()


def test_one_that_lies_still_is_left_alone_and_one_that_drifts_away_is_held_by_a_ring(two):
    assert two.look(0.0) == [[], [0]]
    assert two.look(0.9 * FAR) == [[], [0]]
    (held,), _ = two.look(0.2 * FAR)
    joint = two.joints[0][held]
    assert two.hands.mode[joint] == LEAD_MODE
    assert two.hands.goal[joint] == pytest.approx(two.middle[joint])


def test_between_moves_it_is_looked_at_four_times_a_second(two):
    two.look(0.0)
    assert two.look(2.0 * FAR, begun=False) == [[], [0]]
    assert two.look(0.0, begun=False) == [[], [0]]
    assert two.look(0.0, begun=False)[0] != []


def test_a_hand_that_holds_it_gives_way_to_the_next_move_and_then_holds_it_where_it_was(two):
    two.look(0.0)
    (held,), _ = two.look(2.0 * FAR)
    joint = two.joints[0][held]
    goal = two.hands.goal[joint].copy()
    two.aside.take_up()
    assert not two.hands.mode[two.joints[0]].any()
    assert two.look(0.5 * FAR)[0] == [held]
    assert two.hands.goal[joint] == pytest.approx(goal)


def test_what_hands_take_or_displace_is_not_held_any_more(two):
    two.look(0.0)
    two.look(2.0 * FAR)
    two.aside.take_up()
    two.hands.mode[two.joints[0][1]] = GRIP_MODE
    assert two.look(0.0) == [[1], [0]]
    two.hands.mode[two.joints[0][1]] = 0
    two.hands.spins.shift(VertexSet(two.sculpture.scene.vertices_of(0)), np.array([0.1, 0.0, 0.0]))
    assert two.look(2.0 * FAR) == [[], [0]]
    assert two.look(2.0 * FAR) == [[], [0]]


def test_what_hangs_on_what_hands_hold_and_what_lies_while_hands_do_nothing_is_left_alone(two):
    two.hands.weld((int(two.joints[0][1]), int(two.joints[1][1])))
    two.look(0.0)
    assert two.look(2.0 * FAR) == [[], [0]]
    alone = Aside()
    alone.hands.mode[:] = 0
    alone.look(0.0)
    assert alone.look(2.0 * FAR) == [[], []]
