"""Batches: frames made ahead, given out, kept, in threads, and after a failure."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.detail import detail_named
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.solver.batch import Batch, snapshots_of
from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.readback import Readback
from balloon_usd.solver.simulation import model_named, simulate_many
from balloon_usd.solver.snapshot import frames_of
from tests.solver.bits import bits
from tests.solver.small_plan import small

SUBSTEPS = {"latex": 100, "kosaka": 12}


def failing():
    """A loop that takes more than half of a balloon without tail."""
    return small(head=9, kind="loop", physics="burst: stop", seconds=2.0, length=3.4, tail=0)


def batch_of(*plans, ahead, most=1000):
    model = plans[0].recipe.physics.model
    meshes = [tuple(mesh_of(s, detail_named("draft")) for s in plan.strips.values()) for plan in plans]
    counts = [min(most, 1 + round(plan.choreography.seconds * plan.recipe.fps)) for plan in plans]
    return Batch(model_named(model), plans, meshes, counts, SUBSTEPS[model], "cpu", ahead=ahead, threads=1)


def frames_from(batch):
    layout = batch.model.layout
    return frames_of(snapshots_of([batch], layout.extent.frame_arrays), layout.places)


def all_bits(batch):
    return [[bits(outcome) for outcome in outcomes] for outcomes in frames_from(batch)]


@pytest.mark.parametrize("physics", ["model: latex", "model: kosaka"])
def test_frames_made_ahead_are_those_made_when_asked_for(physics):
    plans = small(physics=physics), small(head=5, physics=physics)
    ahead, asked = (all_bits(batch_of(*plans, ahead=way)) for way in (True, False))
    assert len(ahead) > 20
    assert ahead == asked


def test_a_plan_that_fails_while_the_next_frame_is_made_gives_nothing_more_and_leaves_the_others_alone():
    plans = failing(), small(physics="burst: stop", seconds=3.0)
    ahead = list(frames_from(batch_of(*plans, ahead=True)))
    first = [outcomes[0] for outcomes in ahead]
    (end,) = (k for k, outcome in enumerate(first) if isinstance(outcome, SimulationFailed))
    assert "loop twist: head: head bursts" in str(first[end])
    assert all(outcome is None for outcome in first[end + 1 :])
    alone = [bits(outcomes[0]) for outcomes in frames_from(batch_of(plans[1], ahead=False))]
    assert [bits(outcomes[1]) for outcomes in ahead] == alone
    assert len(alone) > end + 2


def test_hands_do_not_reach_for_what_has_flown_apart():
    plans = small(), small(head=5)
    batch = batch_of(*plans, ahead=True)
    acted, frames = [], frames_from(batch)
    for performer in batch.model.performers:
        act = performer.act
        performer.act = lambda *now, act=act, who=performer: (acted.append(who), act(*now))
    given = [next(frames) for _ in range(5)]
    places = batch.model.scene.x.numpy().copy()
    places[: len(given[0][0].points[0])] = np.nan
    batch.model.scene.x.assign(places)
    given += frames
    failed = [outcomes[0] for outcomes in given if isinstance(outcomes[0], SimulationFailed)]
    assert len(failed) == 1
    assert "flown apart" in str(failed[0])
    assert acted.count(batch.model.performers[0]) <= failed[0].frame
    assert acted.count(batch.model.performers[1]) == len(given) - 1
    alone = [bits(outcomes[0]) for outcomes in frames_from(batch_of(plans[1], ahead=False))]
    assert [bits(outcomes[1]) for outcomes in given] == alone


def test_a_batch_ends_with_the_failure_of_its_last_plan():
    outcomes = [o for (o,) in frames_from(batch_of(failing(), ahead=True))]
    assert isinstance(outcomes[-1], SimulationFailed)
    assert all(isinstance(outcome, Frame) for outcome in outcomes[:-1])


@pytest.mark.parametrize("physics", ["model: latex", "model: kosaka"])
@pytest.mark.parametrize("ahead", [True, False])
def test_frames_that_were_given_out_stay_as_they_were(ahead, physics):
    given = [(f, bits(f)) for (f,) in frames_from(batch_of(small(physics=physics), ahead=ahead))]
    assert all(bits(frame) == then for frame, then in given)


@pytest.mark.parametrize(("ahead", "begun"), [(True, [1, 2, 3]), (False, [0, 1, 2])])
def test_only_the_next_frame_is_made_ahead_and_none_before_the_first_unless_asked(ahead, begun):
    batch = batch_of(small(), ahead=ahead, most=4)
    counted, advance = [], batch.model.advance
    batch.model.advance = lambda *span: (counted.append(span), advance(*span))
    frames = frames_from(batch)
    assert [(next(frames), len(counted))[1] for _ in range(3)] == begun
    assert len(list(frames)) == 1
    assert len(counted) == 3


def test_a_batch_that_is_left_early_waits_for_what_it_has_begun():
    batch = batch_of(small(), ahead=True)
    rested = []
    batch.model.rest = lambda: rested.append(True)
    frames = frames_from(batch)
    next(frames)
    assert rested == []
    frames.close()
    assert rested == [True]


def in_threads(plans, threads, monkeypatch, most):
    monkeypatch.setattr("balloon_usd.solver.simulation.usable_cores", lambda: threads)
    found = zip(range(most), simulate_many(plans, device="cpu").frames(), strict=False)
    return [[bits(outcome) for outcome in outcomes] for _, outcomes in found]


def test_sculptures_in_threads_come_out_as_each_alone(monkeypatch):
    plans = [small(), small(head=5, seconds=0.5), small(head=7)]
    together = in_threads(plans, 2, monkeypatch, 1000)
    for world, plan in enumerate(plans):
        alone = [outcomes[0] for outcomes in in_threads([plan], 2, monkeypatch, 1000)]
        assert [outcomes[world] for outcomes in together[: len(alone)]] == alone
        assert all(outcomes[world] == "None" for outcomes in together[len(alone) :])


def test_more_sculptures_than_flat_states_come_out_as_in_one(monkeypatch):
    plans = [small(head=4.0 + 0.25 * k) for k in range(10)]
    assert in_threads(plans, 2, monkeypatch, 5) == in_threads(plans, 1, monkeypatch, 5)


def test_threads_share_out_the_sculptures_of_the_kosaka_model_to_none(monkeypatch):
    monkeypatch.setattr("balloon_usd.solver.simulation.usable_cores", lambda: 2)
    plans = [small(physics="model: kosaka"), small(head=5, physics="model: kosaka")]
    model = simulate_many(plans, device="cpu").model
    assert len(model.performers) == 2


def test_a_read_back_is_valid_for_two_more():
    scene = batch_of(small(), ahead=False).model.scene
    readback = Readback(scene, ["x"])
    read = []
    for number in range(4):
        scene.x.fill_(float(number))
        readback.next_buffer()
        readback.copy()
        read.append(readback.arrays()["x"])
        assert [float(x[0, 0]) for x in read[-3:]] == [float(k) for k in range(number + 1)][-3:]
    assert np.shares_memory(read[0], read[3])
