"""Springs pull as the thesis says (eqs. 3.1, 3.2, 3.19), and what is added to them moves no balloon."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.kernels.kosaka.springs import (
    HALF_EACH,
    limit_elongation,
    pull_springs,
    spring_stretch,
)
from tests.solver import kosaka_reference as thesis
from tests.solver.kosaka_bench import DEVICES, Sample, by_balloon, launch, laws, leftover, off, sample

DT = 1e-3
CALM = 30.0


@pytest.fixture(scope="module")
def rubber() -> Sample:
    return sample(seed=31)


def pull(s: Sample, device: str, **changes: float):
    forces = np.zeros_like(s.x)
    return launch(pull_springs, device, len(s.x), **s.host(**changes), spring_pull=forces)["spring_pull"]


def shorten(s: Sample, device: str, held: np.ndarray):
    """What has become of the net after a step in which a hand closes a ring of some vertices."""
    host = s.host() | {
        "vertex_joint": np.where(held, 1, -1).astype(np.int32),
        "radius_to": np.array([0.0, 0.005]),
    }
    return launch(limit_elongation, device, len(s.x), **host, dt=DT, x_next=np.zeros_like(s.x))


def nobody(s: Sample) -> np.ndarray:
    return np.zeros(len(s.x), dtype=bool)


def one_spring(device: str, apart: float, speed: float = 0.0, **law: float):
    """What a spring of natural length 1 along x does to its two ends."""
    ends = np.full((2, 4), -1, dtype=np.int32)
    ends[:, 0] = 1, 0
    return launch(
        pull_springs,
        device,
        2,
        spring_ends=ends,
        vertex_balloon=np.zeros(2, dtype=np.int32),
        constants=laws(**law),
        natural=np.ones((2, 4)),
        x=np.array([[0.0, 0.0, 0.0], [apart, 0.0, 0.0]]),
        v=np.array([[0.0, 0.0, 0.0], [speed, 0.0, 0.0]]),
        spring_pull=np.zeros((2, 3)),
    )["spring_pull"]


@pytest.mark.parametrize("device", DEVICES)
def test_springs_pull_as_in_the_thesis(device, rubber):
    s = rubber
    ks, kd = (by_balloon(name, s.edge_balloon) for name in ("ks", "kd"))
    wanted = thesis.spring_sum(s.edges, s.natural, s.x, s.v, ks, kd)
    assert off(pull(s, device), wanted) < 1e-5


@pytest.mark.parametrize("device", DEVICES)
def test_a_spring_longer_than_natural_draws_its_ends_together(device):
    forces = one_spring(device, apart=1.5, ks=10.0, kd=0.0)
    assert forces == pytest.approx(np.array([[5.0, 0.0, 0.0], [-5.0, 0.0, 0.0]]))


@pytest.mark.parametrize("device", DEVICES)
def test_a_spring_shorter_than_natural_drives_its_ends_apart(device):
    forces = one_spring(device, apart=0.5, ks=10.0, kd=0.0)
    assert forces == pytest.approx(np.array([[-5.0, 0.0, 0.0], [5.0, 0.0, 0.0]]))


@pytest.mark.parametrize("device", DEVICES)
def test_a_spring_resists_being_drawn_out(device):
    forces = one_spring(device, apart=1.0, speed=2.0, ks=10.0, kd=3.0)
    assert forces == pytest.approx(np.array([[6.0, 0.0, 0.0], [-6.0, 0.0, 0.0]]))


@pytest.mark.parametrize("device", DEVICES)
def test_springs_do_not_push_the_balloon_as_a_whole(device, rubber):
    assert leftover(pull(rubber, device)) < 1e-6


@pytest.mark.parametrize("device", DEVICES)
def test_calming_damps_only_what_moves_across_springs(device, rubber):
    s = rubber
    calming = np.full(len(s.edges), CALM)
    added = pull(s, device, ks=0.0, kd=0.0, calming=CALM)
    assert off(added, thesis.calming_sum(s.edges, s.x, s.v, calming)) < 1e-5
    along = one_spring(device, apart=1.0, speed=2.0, ks=10.0, kd=0.0, calming=CALM)
    assert along == pytest.approx(np.zeros((2, 3)))


@pytest.mark.parametrize("device", DEVICES)
def test_calming_does_not_push_the_balloon_as_a_whole(device, rubber):
    assert leftover(pull(rubber, device, ks=0.0, kd=0.0, calming=CALM)) < 1e-6


@pytest.mark.parametrize("closing", [False, True], ids=["free", "beside a ring that is closed"])
@pytest.mark.parametrize("device", DEVICES)
def test_springs_that_are_too_long_are_shortened(device, closing, rubber):
    s, held = rubber, nobody(rubber)
    held[:30] = closing
    longest = (1.0 + by_balloon("elongation_limit", s.edge_balloon)) * s.natural
    wanted = thesis.shortening(s.edges, s.x, longest, HALF_EACH, held)
    after = shorten(s, device, held)
    assert off(after["v"] - s.v, wanted / DT) < 1e-5
    assert off(after["x_next"], s.x + wanted) < 1e-6
    assert np.array_equal(after["x_next"][held], s.x[held].astype(np.float32))
    assert np.array_equal(after["v"][held], s.v[held].astype(np.float32))


@pytest.mark.parametrize("device", DEVICES)
def test_shortening_springs_does_not_push_the_balloon_as_a_whole(device, rubber):
    assert leftover(shorten(rubber, device, nobody(rubber))["v"] - rubber.v) < 1e-6


@pytest.mark.parametrize("device", DEVICES)
def test_springs_within_their_limit_are_left_alone(device, rubber):
    s = rubber
    host = s.host(elongation_limit=20.0)
    after = launch(limit_elongation, device, len(s.x), **host, dt=DT, x_next=np.zeros_like(s.x))
    assert np.array_equal(after["x_next"], s.x.astype(np.float32))
    assert np.array_equal(after["v"], s.v.astype(np.float32))


@pytest.mark.parametrize("device", DEVICES)
def test_the_stretch_at_a_vertex_is_that_of_its_longest_spring(device, rubber):
    s = rubber
    stretch = thesis.length(s.x[s.edges[:, 1]] - s.x[s.edges[:, 0]]) / s.natural
    wanted = np.zeros(len(s.x))
    np.maximum.at(wanted, s.edges, stretch[:, None])
    kept = {"stretch": np.zeros(len(s.x)), "travel_limit": 1.0}
    found = launch(spring_stretch, device, len(s.x), **s.host(), **kept)["stretch"]
    assert off(found, wanted) < 1e-5
