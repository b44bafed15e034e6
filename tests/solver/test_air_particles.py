"""Air particles repel each other and move as the thesis says (eqs. 3.3, 3.4, 3.16, 3.20, 3.21)."""

from __future__ import annotations

import numpy as np
import pytest
import warp as wp

from balloon_usd.solver.kernels.kosaka.air_particles import NEAREST, move_air, repel_air
from tests.solver import kosaka_reference as thesis
from tests.solver.kosaka_bench import (
    DEVICES,
    Sample,
    by_balloon,
    drift_of,
    drifts,
    launch,
    laws,
    leftover,
    listed,
    off,
    sample,
)

DT = 1e-3
DRAG = 30.0


@pytest.fixture(scope="module")
def air() -> Sample:
    return sample(seed=32, particles=700)


def in_clusters(s: Sample) -> list[np.ndarray]:
    """All other particles of its cluster, for every particle."""
    same = s.air_cluster[:, None] == s.air_cluster
    np.fill_diagonal(same, val=False)
    return [np.flatnonzero(row) for row in same]


def repelled(s: Sample, device: str):
    count, neighbours = listed(in_clusters(s), device)
    host = s.host() | {
        "neighbour_count": count,
        "neighbours": neighbours,
        "air_push": np.zeros_like(s.air),
    }
    return launch(repel_air, device, len(s.air), **host)["air_push"]


def few(device: str, places, **law: float):
    """Repulsions of a few particles that all are neighbours."""
    count, neighbours = listed([np.delete(np.arange(len(places)), a) for a in range(len(places))], device)
    return launch(
        repel_air,
        device,
        len(places),
        air_balloon=np.zeros(len(places), dtype=np.int32),
        constants=laws(**law),
        neighbour_count=count,
        neighbours=neighbours,
        air=np.array(places, dtype=float),
        air_push=np.zeros((len(places), 3)),
    )["air_push"]


def moved(s: Sample, device: str, push, wall, **law: float):
    return launch(move_air, device, len(s.air), **s.host(**law), dt=DT, air_push=push, wall_push=wall)


@pytest.mark.parametrize("device", DEVICES)
def test_particles_repel_each_other_as_in_the_thesis(device, air):
    alpha, re = (by_balloon(name, air.air_balloon) for name in ("alpha", "re"))
    wanted = [
        thesis.repulsion_sum(a, air.air, row, alpha[a], re[a]) if len(row) else np.zeros(3)
        for a, row in enumerate(in_clusters(air))
    ]
    assert off(repelled(air, device), np.array(wanted)) < 1e-5


@pytest.mark.parametrize("device", DEVICES)
def test_repulsion_does_not_move_the_air_as_a_whole(device, air):
    assert leftover(repelled(air, device)) < 1e-6


@pytest.mark.parametrize("device", DEVICES)
def test_two_particles_are_driven_apart_and_the_harder_the_nearer(device):
    near, far = (few(device, [(0, 0, 0), (r, 0, 0)], alpha=100.0, re=0.01) for r in (0.002, 0.008))
    assert near[0, 0] < far[0, 0] < 0.0 < far[1, 0] < near[1, 0]
    assert near[1, 0] == pytest.approx(100.0 * 0.002 * (0.01 / 0.002 - 1.0), rel=1e-6)


@pytest.mark.parametrize("device", DEVICES)
def test_particles_beyond_their_reach_do_nothing_to_each_other(device):
    assert not few(device, [(0, 0, 0), (0.0101, 0, 0)], re=0.01).any()


@pytest.mark.parametrize("device", DEVICES)
def test_particles_in_one_place_do_not_break_anything(device):
    forces = few(device, [(0, 0, 0), (0, 0, 0), (0.1 * NEAREST, 0, 0)])
    assert np.isfinite(forces).all()


@pytest.mark.parametrize("device", DEVICES)
def test_evenly_placed_air_is_at_rest_inside(device):
    steps = np.arange(-3, 4)
    places = 0.004 * np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    forces = few(device, places, alpha=100.0, re=0.01)
    middle = len(places) // 2
    assert np.linalg.norm(forces[middle]) < 1e-5 * np.linalg.norm(forces, axis=1).max()


@pytest.mark.parametrize("device", DEVICES)
def test_air_moves_by_symplectic_euler(device, air):
    random = np.random.default_rng(5)
    push, wall = (random.normal(0.0, 200.0, air.air.shape).astype(np.float32) for _ in range(2))
    after = moved(air, device, push, wall)
    u = thesis.next_air_speed(air.air_speed, push.astype(float), wall.astype(float), DT)
    assert off(after["air_speed"], u) < 1e-5
    assert off(after["air"], thesis.next_air(air.air, u, DT)) < 1e-6


@pytest.mark.parametrize("device", DEVICES)
def test_drag_slows_air_down_to_the_drift_of_its_bubble(device, air):
    s, none = air, np.zeros_like(air.air)
    drift = np.array([thesis.drift(x, **drift_of(k)) for x, k in zip(s.air, s.air_cluster, strict=True)])
    host = s.host(drag=DRAG) | {"dt": DT, "drifts": drifts(), "air_push": none, "wall_push": none}
    after = launch(move_air, device, len(s.air), **host)["air_speed"]
    assert off(after, s.air_speed - DRAG * (s.air_speed - drift) * DT) < 1e-5


@pytest.mark.parametrize("device", DEVICES)
def test_air_gains_the_speed_that_the_ends_of_its_bubble_gain(device, air):
    s, none = air, np.zeros_like(air.air)
    random, gaining, wanted = np.random.default_rng(6), drifts(), s.air_speed.copy()
    for k, drift in enumerate(gaining):
        gains = random.normal(0.0, 50.0, (2, 3))
        drift.start_gain, drift.end_gain = (wp.vec3(*gain) for gain in gains)
        ends = drift_of(k) | {"start_speed": gains[0], "end_speed": gains[1]}
        for p in np.flatnonzero(s.air_cluster == k):
            wanted[p] += thesis.drift(s.air[p], **ends) * DT
    host = s.host(drag=0.0) | {"dt": DT, "drifts": gaining, "air_push": none, "wall_push": none}
    assert off(launch(move_air, device, len(s.air), **host)["air_speed"], wanted) < 1e-5


@pytest.mark.parametrize("device", DEVICES)
def test_no_particle_is_faster_than_allowed_nor_turned_aside(device, air):
    none = np.zeros_like(air.air)
    speed = thesis.length(air.air_speed)
    most = float(np.median(speed))
    after = moved(air, device, none, none, air_speed=most)["air_speed"]
    assert off(after, air.air_speed * np.minimum(1.0, most / speed)[:, None]) < 1e-5
