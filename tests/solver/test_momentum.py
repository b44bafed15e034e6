"""What floats has neither momentum nor angular momentum, and moves in itself as before."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.simulation import simulate_many
from tests.solver.locked_pair import locked_pair


@pytest.fixture(scope="module")
def pair():
    """A finished locked pair."""
    simulation = simulate_many([locked_pair()], detail="draft", device="cpu")
    assert all(frames for frames in simulation.frames())
    return simulation


def stirred(simulation, *, floating):
    """Velocities of all vertices, (V, 3), m/s, before and after a frame in which no wall is in the way."""
    scene = simulation.model.scene
    before = np.random.default_rng(7).normal(0.1, 0.3, (len(scene.x), 3)).astype(np.float32)
    scene.v.assign(before)
    scene.floating.fill_(int(floating))
    simulation.model.stepper._untangling.leave()
    simulation.model.stepper._untangling.end_frame()
    return before.astype(float), scene.v.numpy().astype(float)


def momenta(scene, velocity):
    """Momentum (kg m/s) and angular momentum about the middle of mass (kg m2/s) of each vertex."""
    mass, x = scene.mass.numpy().astype(float)[:, None], scene.x.numpy().astype(float)
    arm = x - (mass * x).sum(axis=0) / mass.sum()
    return mass * velocity, mass * np.cross(arm, velocity)


def test_what_floats_loses_its_momenta_and_nothing_of_how_it_moves_in_itself(pair):
    scene = pair.model.scene
    before, after = stirred(pair, floating=True)
    for had, left in zip(momenta(scene, before), momenta(scene, after), strict=True):
        assert np.linalg.norm(had.sum(axis=0)) > 1e-2 * np.abs(had).sum()
        assert np.linalg.norm(left.sum(axis=0)) < 1e-5 * np.abs(had).sum()
    # How fast any two vertices come nearer is the same.
    x = scene.x.numpy().astype(float)
    a, b = np.random.default_rng(3).choice(len(x), (2, 500))
    was, now = (((v[a] - v[b]) * (x[a] - x[b])).sum(axis=1) for v in (before, after))
    assert now == pytest.approx(was, abs=1e-6)


def test_what_hands_hold_keeps_its_momenta_to_the_last_bit(pair):
    before, after = stirred(pair, floating=False)
    assert np.array_equal(before, after)
