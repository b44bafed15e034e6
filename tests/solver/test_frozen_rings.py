"""Rings are drawn to their mean and freeze (Kosaka 2008, 3.6), and rubber moves by eqs. 3.22 and 3.23."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.kernels.kosaka.frozen_rings import hold_rings, move_rubber
from tests.solver import kosaka_reference as thesis
from tests.solver.kosaka_bench import (
    DEVICES,
    LAWS,
    Sample,
    by_balloon,
    drift_of,
    drifts,
    launch,
    off,
    sample,
    single,
)
from tests.solver.kosaka_scenes import borders, freeze, one_frame, small_model

DT = 1e-3
MEAN = np.array([0.04, 0.001, -0.002])
WIDE, NARROW, FRACTION = 0.02, 0.008, 0.25
"""Radius of a ring that is being closed, at the frame's start and end, and how far the frame has come."""
RING = 12


@pytest.fixture(scope="module")
def rubber() -> Sample:
    return sample(seed=35, particles=1)


@pytest.fixture(scope="module")
def forces(rubber):
    """Springs' pull and air's push on every vertex."""
    random = np.random.default_rng(36)
    return tuple(single(random.normal(0.0, size, rubber.x.shape)) for size in (300.0, 100.0))


def rings(vertices: int) -> np.ndarray:
    """Which ring every vertex belongs to: the first dozen is being closed, the next is frozen."""
    joint = np.full(vertices, -1, dtype=np.int32)
    joint[:RING], joint[RING : 2 * RING] = 0, 1
    return joint


def moved(s: Sample, device: str, forces, drag: float = 0.0, gravity: float = 0.0):
    balloons = len(LAWS)
    host = s.host() | {
        "vertex_joint": rings(len(s.x)),
        "gravity": np.tile([0.0, 0.0, -gravity], (balloons, 1)),
        "drag": np.full(balloons, drag),
        "dt": DT,
        "fraction": FRACTION,
        "frozen": np.array([0, 1], dtype=np.int32),
        "radius_from": np.array([WIDE, WIDE]),
        "radius_to": np.array([NARROW, NARROW]),
        "ring_middle": np.array([MEAN, MEAN]),
        "drifts": drifts(),
        "spring_pull": forces[0],
        "air_pull": forces[1],
    }
    return launch(move_rubber, device, len(s.x), **host)


@pytest.mark.parametrize("device", DEVICES)
def test_rubber_moves_by_symplectic_euler(device, rubber, forces):
    s, (pull, push) = rubber, forces
    after = moved(s, device, forces)
    free = rings(len(s.x)) < 0
    v = thesis.next_rubber_speed(s.v, 0.0, push, pull, DT)
    assert off(after["v"][free], v[free]) < 1e-5
    assert off(after["x_next"][free], thesis.next_rubber(s.x, v, DT)[free]) < 1e-6


@pytest.mark.parametrize("device", DEVICES)
def test_a_ring_is_drawn_to_its_mean_by_a_limited_force(device, rubber, forces):
    s, (pull, push) = rubber, forces
    ring = rings(len(s.x)) == 0
    limit = by_balloon("force_limit", s.vertex_balloon[ring])
    radius = WIDE + FRACTION * (NARROW - WIDE)
    others = (pull + push)[ring]
    f = thesis.pinch_force(s.x[ring], s.v[ring], MEAN, radius, others, limit[:, None], DT)
    v = thesis.next_rubber_speed(s.v[ring], f, push[ring], pull[ring], DT)
    after = moved(s, device, forces)
    assert off(after["v"][ring], v) < 1e-5
    felt = (after["v"][ring] - s.v[ring]) / DT - others
    assert np.linalg.norm(felt, axis=1).max() < 1.001 * limit.max()


@pytest.mark.parametrize("device", DEVICES)
def test_frozen_vertices_neither_move_nor_gain_speed(device, rubber, forces):
    ring = rings(len(rubber.x)) == 1
    after = moved(rubber, device, forces, gravity=9.8)
    assert np.array_equal(after["x_next"][ring], rubber.x[ring].astype(np.float32))
    assert np.array_equal(after["v"][ring], rubber.v[ring].astype(np.float32))


@pytest.mark.parametrize("device", DEVICES)
def test_gravity_and_drag_act_on_free_rubber(device, rubber):
    s, none = rubber, (np.zeros_like(rubber.x),) * 2
    free = rings(len(s.x)) < 0
    after = moved(s, device, none, drag=20.0, gravity=9.8)["v"]
    # A vertex drifts with the bubble of its first face.
    cluster = s.quad_cluster[s.host()["corners"][:, 0] // 4]
    drift = np.array([thesis.drift(x, **drift_of(k)) for x, k in zip(s.x, cluster, strict=True)])
    wanted = s.v - ([0.0, 0.0, 9.8] + 20.0 * (s.v - drift)) * DT
    assert off(after[free], wanted[free]) < 1e-5


def ring_of(radius: float) -> np.ndarray:
    turn = 2.0 * np.pi * np.arange(RING) / RING
    return single(MEAN + radius * np.stack([0.0 * turn, np.cos(turn), np.sin(turn)], axis=1))


def held(device: str, radius: float, *, closing: bool = True, frozen: bool = False, goal=None):
    """One ring after a step in which its hand, if there is a goal, has come that far."""
    none = np.zeros((1, 3))
    to = none if goal is None else np.array([goal])
    return launch(
        hold_rings,
        device,
        1,
        joint_first=np.zeros(1, dtype=np.int32),
        joint_around=np.full(1, RING, dtype=np.int32),
        joint_mass=np.ones(1),
        joint_neck=np.full(1, 0.006),
        dt=DT,
        frame_seconds=0.04,
        fraction=1.0,
        hand=np.full(1, goal is not None, dtype=np.int32),
        hand_from=to,
        hand_to=to,
        hand_free=none,
        hand_force=np.zeros(1),
        hand_stiffness=np.zeros(1),
        radius_to=np.full(1, 0.006 if closing else 0.0),
        x=ring_of(radius),
        v=np.tile([0.0, 0.1, 0.2], (RING, 1)),
        frozen=np.full(1, frozen, dtype=np.int32),
        ring_middle=none,
        ring_area=none,
    )


@pytest.mark.parametrize("device", DEVICES)
def test_a_ring_freezes_when_its_vertices_coincide(device):
    assert held(device, 0.006)["frozen"][0] == 1
    assert held(device, 0.009)["frozen"][0] == 0
    assert held(device, 0.006, closing=False)["frozen"][0] == 0


@pytest.mark.parametrize("device", DEVICES)
def test_a_frozen_ring_stays_at_rest_where_nobody_holds_it(device):
    after = held(device, 0.006, frozen=True)
    assert np.array_equal(after["x"], ring_of(0.006).astype(np.float32))
    assert not after["v"].any()


@pytest.mark.parametrize("device", DEVICES)
def test_a_frozen_ring_goes_as_a_whole_with_the_hand_that_holds_it(device):
    shift = np.array([0.001, 0.002, -0.001])
    after = held(device, 0.006, frozen=True, goal=MEAN + shift)
    assert off(after["x"], ring_of(0.006) + shift) < 1e-6
    assert after["v"] == pytest.approx(np.tile(shift / DT, (RING, 1)), rel=1e-3)


@pytest.mark.parametrize("device", DEVICES)
def test_where_a_ring_is_and_what_it_spans_is_written(device):
    after = held(device, 0.009)
    assert after["ring_middle"][0] == pytest.approx(MEAN, abs=1e-8)
    spanned = 0.5 * RING * np.sin(2.0 * np.pi / RING) * 0.009**2
    assert after["ring_area"][0] == pytest.approx([spanned, 0.0, 0.0], rel=1e-4, abs=1e-9)


@pytest.mark.parametrize("device", DEVICES)
def test_a_frozen_ring_stays_when_springs_beside_it_are_shortened(device):
    model = small_model(device)
    scene, joint = model.scene, borders(model)[0]
    freeze(model, joint)
    first, around = (int(scene.arrays[name].numpy()[joint]) for name in ("joint_first", "joint_around"))
    x = scene.x.numpy()
    before = x[first : first + around].copy()
    x[x[:, 0] > before[0, 0] + 1e-4] += [0.1, 0.0, 0.0]
    scene.x.assign(x)
    one_frame(model)
    assert np.array_equal(scene.x.numpy()[first : first + around], before)
