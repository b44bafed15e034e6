"""The force with which walls press on each bubble."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.simulation import simulate_many
from tests.solver.locked_pair import locked_pair


def made():
    """The simulation of a locked pair at its end, and its last frame."""
    simulation = simulate_many([locked_pair()], detail="draft", device="cpu")
    return simulation, [frames[0] for frames in simulation.frames()]


@pytest.fixture(scope="module")
def pair():
    return made()


def normal_loads(scene):
    """Normal contact force that every vertex puts on every quad that it touches: vertex, quad, N."""
    x, quads, target = scene.x.numpy().astype(float), scene.quads.numpy(), scene.target.numpy()
    # On a CPU the vectors of one vertex lie together.
    force = scene.contact_force.numpy().astype(float).reshape(-1, 2, 3)
    for vertex, slot in zip(*np.nonzero(target >= 0), strict=True):
        c = x[quads[target[vertex, slot]]]
        face = np.cross(c[2] - c[0], c[3] - c[1])
        yield vertex, target[vertex, slot], max(0.0, force[vertex, slot] @ face / np.linalg.norm(face))


def test_a_bubble_is_pressed_where_it_touches_and_where_it_is_touched(pair):
    simulation, frames = pair
    scene = simulation.model.scene
    quads, segment = scene.quads.numpy(), scene.quad_segment.numpy()
    wanted = np.zeros(segment.max() + 1)
    for vertex, quad, load in normal_loads(scene):
        wanted[segment[quad]] += load
        beside = np.flatnonzero((quads == vertex).any(axis=1))
        np.add.at(wanted, segment[beside], load / len(beside))
    assert wanted.sum() > 10.0
    assert frames[-1].contact == pytest.approx(wanted[2:], rel=1e-4)


def test_locked_bubbles_press_on_each_other_as_hard_as_a_few_newtons(pair):
    contact = pair[1][-1].contact
    left, right = contact[1:3]
    assert 3.0 < left < 40.0
    assert left == pytest.approx(right, rel=0.2)
    assert contact[1:3].min() > contact[[0, 3]].max()


def test_walls_that_touch_nothing_are_not_pressed(pair):
    flat, blown = pair[1][0], pair[1][10]
    assert not flat.contact.any()
    assert not blown.contact.any()


def test_two_runs_press_with_the_same_bits(pair):
    again = made()[1]
    assert all(np.array_equal(a.contact, b.contact) for a, b in zip(pair[1], again, strict=True))
