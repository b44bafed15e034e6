"""Snapshots: flat arrays of all plans in memory of the caller's, and what has changed."""

from __future__ import annotations

from functools import cache
from itertools import cycle

import numpy as np
import pytest

from balloon_usd.solver.frame import Frame
from balloon_usd.solver.simulation import simulate_many
from tests.solver.bits import bits
from tests.solver.small_plan import small


def three():
    """Two plans of different lengths and one between them that soon bursts."""
    burst = "burst: stop"
    return [small(physics=burst), small(9, "loop", burst, 2, 3.4, 0), small(5, physics=burst, seconds=3)]


def two_of_kosaka():
    return [small(4, physics="model: kosaka", seconds=0.5), small(3, physics="model: kosaka", seconds=0.7)]


@pytest.fixture(params=["one flat state", "several"])
def states(request, monkeypatch):
    """Whether plans that advance together are in one flat state or in several."""
    monkeypatch.setattr(
        "balloon_usd.solver.simulation.usable_cores", lambda: 1 + (request.param == "several")
    )
    return request.param


def simulated(plans):
    """A simulation and all its snapshots."""
    simulation = simulate_many(plans, device="cpu")
    return simulation, list(simulation.snapshots())


@cache
def three_simulated(states):
    """The three plans simulated in states of the fixture, and all snapshots."""
    return simulated(three())


def assert_frames_are_snapshots(plans, simulation, snapshots):
    frames = simulate_many(plans, device="cpu").frames()
    told = [None] * len(plans)
    for shot, outcomes in zip(snapshots, frames, strict=True):
        for change in shot.changes:
            told[change.plan] = change
        assert shot.made.tolist() == [isinstance(outcome, Frame) for outcome in outcomes]
        for k in np.flatnonzero(shot.made):
            place = simulation.places[k]
            frame = shot.arrays.frame(place, shot.time_code, told[k].doing, told[k].undone)
            assert bits(frame) == bits(outcomes[k])


def test_snapshots_hold_the_frames_of_all_plans(states):
    assert_frames_are_snapshots(three(), *three_simulated(states))


def test_snapshots_hold_the_air_of_all_plans():
    assert_frames_are_snapshots(two_of_kosaka(), *simulated(two_of_kosaka()))


def test_a_change_is_told_once_and_a_failure_with_it(states):
    _, shots = three_simulated(states)
    assert [change.plan for change in shots[0].changes] == [0, 1, 2]
    told = [change for shot in shots for change in shot.changes]
    assert len(told) < len(shots)
    (failed,) = (change for change in told if change.failed)
    assert failed.plan == 1
    assert "loop twist: head: head bursts" in str(failed.failed)
    assert failed is [change for change in told if change.plan == 1][-1]
    assert not any(shot.made[1] for shot in shots[failed.failed.frame - 1 :])
    texts = [(change.doing, change.undone) for change in told if change.plan == 2]
    assert all(now != then for now, then in zip(texts[1:], texts, strict=False))


def test_snapshots_are_written_into_memory_that_the_caller_gives(states):
    simulation = simulate_many(three(), device="cpu")
    slots = [simulation.extent.frame_arrays(np.zeros) for _ in range(2)]
    turns = cycle(slots)
    given = simulation.snapshots(lambda: next(turns))
    _, expected = three_simulated(states)
    for k, (shot, fresh) in enumerate(zip(given, expected, strict=True)):
        assert np.shares_memory(shot.arrays.points, slots[k % 2].points)
        assert len(shot.arrays.points) == simulation.extent.vertices
        if shot.made.all():
            assert shot.arrays.points.tobytes() == fresh.arrays.points.tobytes()
            assert shot.arrays.contact.tobytes() == fresh.arrays.contact.tobytes()


def test_no_more_memory_is_asked_for_than_there_are_snapshots():
    simulation = simulate_many([small()], device="cpu")
    asked = []
    shots = list(simulation.snapshots(lambda: (asked.append(1), simulation.extent.frame_arrays())[1]))
    assert len(asked) == len(shots) == simulation.frame_counts[0]
