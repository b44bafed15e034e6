"""Threads of a CPU that share a sculpture: they change no bit, and take part only where that is faster."""

from __future__ import annotations

import hashlib
import threading
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import numpy as np
import pytest
import warp as wp

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.pace import FIRST_TRIAL, LAST_TRIAL, TRIAL, Pace
from balloon_usd.solver.simulation import simulate_many
from balloon_usd.solver.team import Team

EAR = """
format: 1
name: ear
units: cm
balloons:
  main: {size: 260, inflated: 16}
steps:
  - bubbles: {body: 5}
  - press: {bubble: body, depth: 0.3}
    seconds: 0.2
  - ear: {ear: 4}
  - rest: rest
physics: {hold: 0.1}
"""
"""Its walls would cross as it is folded."""


@pytest.fixture
def whole_teams(monkeypatch):
    """Teams always have all their threads, also for small figures."""
    monkeypatch.setattr(Pace, "threads", property(lambda self: self._most))
    monkeypatch.setattr("balloon_usd.solver.latex.stepper.CHUNKS_PER_THREAD", 1)


def performed(threads):
    """The bits of all frames of an ear, and whether any walls were kept from crossing."""
    bits, kept_apart = hashlib.sha256(), False
    simulation = simulate_many([plan(Recipe.parse(EAR))], device="cpu", threads=threads)
    for (frame,) in simulation.frames():
        bits.update(frame.points[0].tobytes())
        kept_apart |= bool((np.concatenate(frame.slowness) > 0.0).any())
    return bits.hexdigest(), kept_apart


@pytest.mark.usefixtures("whole_teams")
@pytest.mark.parametrize("threads", [2, pytest.param(3, marks=pytest.mark.long)])
def test_frames_have_the_same_bits_for_any_number_of_threads(threads):
    alone, kept_apart = performed(1)
    assert kept_apart, "the rounds in which walls are kept apart are shared out, too"
    assert performed(threads) == (alone, True)


@pytest.mark.usefixtures("whole_teams")
def test_threads_that_share_a_sculpture_end_with_its_simulation():
    before = set(threading.enumerate())
    simulation = simulate_many([plan(Recipe.parse(EAR))], device="cpu", threads=3)
    frames = simulation.frames()
    for _ in range(3):
        next(frames)
    (team,) = {t.name.rsplit("_", 1)[0] for t in set(threading.enumerate()) - before}
    assert team == "team"
    frames.close()
    del simulation, frames
    others = set(threading.enumerate()) - before
    for other in others:
        other.join(10.0)
    assert not any(other.is_alive() for other in others)


class Interrupted(ThreadPoolExecutor):
    """Threads of which only the first is given something to do before an interrupt comes."""

    busy = False

    def submit(self, *task):
        if self.busy:
            raise KeyboardInterrupt
        self.busy = True
        return super().submit(*task)


@pytest.fixture
def team(monkeypatch):
    """A team of three, and the graphs that its threads have replayed."""
    counts, rounds = (wp.zeros(1, dtype=int, device="cpu") for _ in range(2))
    made, passed = Team(3, counts, rounds), []

    def replay(graph):
        if isinstance(graph, Exception):
            raise graph
        passed.append(graph)

    monkeypatch.setattr(wp, "capture_launch", replay)
    return made, passed


def test_a_team_that_is_not_complete_replays_nothing_and_waits_for_nobody(team, monkeypatch):
    made, passed = team
    with monkeypatch.context() as interrupted, Interrupted(3) as pool:
        interrupted.setattr(made, "_pool", pool)
        with pytest.raises(KeyboardInterrupt):
            made.replay(["a", "b", "c"])
    assert passed == []
    made.replay(["a", "b", "c"])
    assert sorted(passed) == ["a", "b", "c"]


def test_what_fails_in_one_thread_of_a_team_fails_for_the_caller(team):
    made, passed = team
    with pytest.raises(RuntimeError, match="no operations"):
        made.replay(["a", RuntimeError("no operations"), "c"])
    assert sorted(passed) == ["a", "c"]


class Frames:
    """Frames that take so long by so many threads, at most the most that are told."""

    def __init__(self, seconds):
        self.seconds = seconds
        self.pace = Pace(max(seconds))

    def make(self, count):
        """Make some; by how many threads each was made."""
        made = []
        for _ in range(count):
            made.append(self.pace.threads)
            self.pace.note(made[-1], self.seconds[made[-1]])
        return made


def test_one_thread_alone_goes_on_when_it_was_faster_in_a_trial():
    frames = Frames({1: 0.5, 2: 1.0})
    assert frames.make(FIRST_TRIAL + TRIAL + FIRST_TRIAL) == [2] * FIRST_TRIAL + [1] * (TRIAL + FIRST_TRIAL)


def test_a_team_comes_back_when_cores_are_free_again():
    frames = Frames({1: 0.5, 2: 1.0})
    frames.make(FIRST_TRIAL + TRIAL)
    frames.seconds[2] = 0.25
    assert frames.make(FIRST_TRIAL + TRIAL + FIRST_TRIAL) == [1] * FIRST_TRIAL + [2] * (TRIAL + FIRST_TRIAL)


@pytest.mark.parametrize("fastest", [1, 3, 6, 12])
def test_a_team_finds_how_many_threads_are_fastest(fastest):
    frames = Frames({n: 1.0 + abs(n - fastest) for n in range(1, 13)})
    frames.make(12 * LAST_TRIAL)
    assert frames.pace.threads == fastest


def test_trials_that_change_nothing_become_rare():
    made = Frames({1: 1.0, 2: 0.5}).make(4 * LAST_TRIAL)
    begins = [k for k, (before, now) in enumerate(pairwise(made)) if (before, now) == (2, 1)]
    gaps = [b - a for a, b in pairwise(begins)]
    assert gaps == sorted(gaps)
    assert gaps[-1] == LAST_TRIAL + TRIAL
    assert made.count(1) < 0.03 * len(made)


def test_a_single_thread_makes_no_trials():
    assert Frames({1: 1.0}).make(3 * LAST_TRIAL) == [1] * 3 * LAST_TRIAL
