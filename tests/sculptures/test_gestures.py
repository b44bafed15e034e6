"""Gestures of the hands in a simulation: a twist and a lock as seen frame by frame."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from balloon_usd.operations.moves import Spin, TurnFold
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many
from tests.sculptures.conftest import middles

EARS = """
format: 1
name: ears
units: cm
balloons: {main: {size: 260, length: 10.5, tail: 5}}
steps:
  - bubbles: {nose: 4, left_ear: 6, right_ear: 6}
  - lock: [left_ear, right_ear]
physics: {hold: 1.5}
"""
ANTENNA = """
format: 1
name: antenna
units: cm
balloons: {main: {size: 260, inflated: 60}}
steps:
  - bubbles: {head: 5}
  - loop: {ring: 12}
  - rest: antenna
  - bend: {antenna: 130}
    point: up
"""
"""A long rest that is bent up, with its flat tail at its end."""
SLACK = 9.0
"""Stretch that no wall of it has, even for a moment."""
FASTEST = 1.5
"""No point of a balloon is led faster by hand, m/s."""


@pytest.fixture(scope="module")
def ears():
    """Two ears locked: all walls, and the middles of all rings, frame by frame."""
    planned = plan(Recipe.parse(EARS))
    simulation = simulate_many([planned], device="cpu")
    walls, rings = [], []
    for (frame,) in simulation.frames():
        walls.append(np.concatenate(frame.points))
        rings.append(middles(simulation, frame))
    return SimpleNamespace(plan=planned, walls=np.array(walls), rings=np.array(rings), fps=simulation.fps)


def during(made, kind):
    """Frames of every move of a kind."""
    moves = [move for move in made.plan.choreography.moves if isinstance(move, kind)]
    return [slice(math.ceil(move.start * made.fps), math.floor(move.end * made.fps) + 1) for move in moves]


def angles(points, about, towards):
    """Angle of points about an axis, frame by frame, continuous, degrees."""
    axis = (towards - about) / np.linalg.norm(towards - about, axis=1)[:, None]
    off = points - about
    off -= (off * axis).sum(axis=1)[:, None] * axis
    first, second = off[0], np.cross(axis[0], off[0])
    return np.degrees(np.unwrap(np.arctan2(off @ second, off @ first)))


def place(made, name):
    """The number of a ring."""
    return next(k for k, ring in enumerate(made.plan.table.rings) if ring.name == name)


def test_nothing_goes_faster_than_hands_lead_it(ears):
    speed = np.linalg.norm(np.diff(ears.walls, axis=0), axis=2).max(axis=1) * ears.fps
    assert speed.max() < FASTEST


def test_a_fold_turns_about_its_joint_as_often_as_the_lock_says_and_ends_as_it_began(ears):
    (turning,) = during(ears, TurnFold)
    base, top = place(ears, "nose.end"), place(ears, "left_ear.end")
    cheek = ears.plan.table.guides("left_ear")[0]
    rings = ears.rings[turning]
    turned = angles(rings[:, cheek], rings[:, base], rings[:, top])
    assert turned[-1] == pytest.approx(3 * 360.0, abs=12.0)
    steps = np.diff(turned)
    assert (steps > -1.0).all()
    # Its axis sways a little besides.
    assert steps.max() < 48.0
    assert np.linalg.norm(rings[-1, cheek] - rings[0, cheek]) < 0.012


def test_what_does_not_turn_is_held_by_the_other_hand(ears):
    (turning,) = during(ears, TurnFold)
    held = [place(ears, "main.knot"), place(ears, "nose.end"), place(ears, "right_ear.end")]
    moved = ears.rings[turning][:, held] - ears.rings[turning.start, held]
    assert np.linalg.norm(moved, axis=2).max() < 0.008


def test_a_balloon_does_not_flail_while_it_is_twisted(ears):
    """What lies beyond the twist turns about its own axis and stays on it."""
    tip = ears.plan.table.guides(ears.plan.bubbles[-1].name)[-1]
    for turning in during(ears, Spin):
        across = ears.rings[turning, tip, 1:]
        assert np.linalg.norm(across - across[0], axis=1).max() < 0.01


def test_joints_of_a_figure_that_was_put_down_stay_where_they_are(ears):
    """Their walls still creep, by less than can be seen."""
    joints = [place(ears, f"{name}.end") for name in ("nose", "left_ear", "right_ear")]
    assert (ears.rings[-8:, joints] == ears.rings[-9, joints]).all()
    speed = np.linalg.norm(np.diff(ears.walls[-9:], axis=0), axis=2).max() * ears.fps
    assert speed < 0.002


def test_the_flat_tail_of_a_rest_that_is_bent_stays_flat():
    planned = plan(Recipe.parse(ANTENNA))
    simulation = simulate_many([planned], device="cpu")
    frames = [frame for (frame,) in simulation.frames()]
    assert max(float(frame.stretch[0].max()) for frame in frames) < SLACK
    end = frames[-1].points[0][-simulation.meshes[0][0].around :]
    width = planned.strips["main"].size.radius * 2.0
    assert np.linalg.norm(np.ptp(end, axis=0)) < 2.0 * width
