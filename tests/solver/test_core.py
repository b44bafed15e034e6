"""The core of a wound neck: packed rubber pushes in pairs, keeps its order, and leaves wide rings alone."""

from __future__ import annotations

import numpy as np
import pytest
import warp as wp

from balloon_usd.bench.pinch_ours import tube_body
from balloon_usd.bench.pinch_task import RADIUS, PinchTask
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.kernels.device.warp_reduce import WARP
from balloon_usd.solver.kernels.physics.surface import ring_radii
from balloon_usd.solver.latex.cores import core_radii
from balloon_usd.solver.latex.scene import build_scene
from balloon_usd.solver.latex.stepper import Stepper
from balloon_usd.solver.launch import Launcher
from balloon_usd.solver.settings import SceneSettings
from balloon_usd.solver.simulation import simulate_many
from tests.solver.core_kernels import press_cores, yield_to_cores

TASK = PinchTask(1602, 0.0)
DT = 1e-3
DEVICES = ["cpu", *(device.alias for device in wp.get_cuda_devices())]
BUBBLES = "format: 1\nname: c\nunits: cm\nballoons: {main: {size: 260, length: 14, tail: 5}}\nsteps: [bubbles: {a: 8}]\n"


def core():
    """Radius of the core, m."""
    return float(core_radii(tube_body(TASK))[TASK.middle])


def neck(radius, turn, rings=3):
    """The tube, (V, 3) m, with some rings in its middle as thin as `radius` (m), each turned by so much (radians)."""
    points = TASK.mesh.points.astype(np.float64)
    for k, _ in enumerate(TASK.mesh.ring_start):
        away = k - TASK.middle
        own = TASK.ring(k)
        angle = turn * np.clip(away, -rings, rings)
        c, s = np.cos(angle), np.sin(angle)
        points[own, 1:] = points[own, 1:] @ np.array([[c, s], [-s, c]])
        if abs(away) <= rings:
            points[own, 1:] *= radius / RADIUS
    return points


def rough(points, seed=3):
    """The same, with every vertex off by a third of a millimetre or so."""
    return points + np.random.default_rng(seed).normal(scale=3e-4, size=points.shape)


def kicked(points, device="cpu"):
    """Speeds (V, 3), m/s, that cores give the tube's vertices in a substep, and their masses (V,), kg."""
    scene = build_scene([tube_body(TASK)], [0], SceneSettings(dt=DT), device, 1, 1)
    scene.x.assign(points.astype(np.float32))
    launcher = Launcher(scene, {"dt": DT})
    rings = int(scene.world_core.numpy()[-1])
    launcher.launch_tiled(ring_radii, rings, lanes=WARP)
    launcher.launch_tiled(press_cores, rings, lanes=WARP)
    launcher.launch_tiled(yield_to_cores, rings, lanes=WARP)
    return scene.v.numpy().astype(np.float64), scene.mass.numpy().astype(np.float64)


def sideways(speed, points):
    """Radial and turning part of the speeds (V, 3) of what lies about the x axis, (V,) each."""
    out = points * [0.0, 1.0, 1.0]
    out /= np.maximum(np.linalg.norm(out, axis=1), 1e-9)[:, None]
    return (speed * out).sum(axis=1), np.cross(out, speed)[:, 0]


def test_the_core_is_as_thick_as_the_rubber_of_the_ring():
    body = tube_body(TASK)
    girth = 32 * 2.0 * np.sin(np.pi / 32) * body.radius
    assert np.pi * core() ** 2 == pytest.approx(girth * body.thickness[0], rel=1e-4)


@pytest.mark.parametrize("device", DEVICES)
def test_rings_that_are_not_thin_feel_nothing(device):
    speed, _ = kicked(rough(neck(2.1 * core(), 0.3)), device)
    assert not speed.any()


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("turn", [0.0, 1.0, 2.5])
def test_a_crumpled_neck_gets_neither_momentum_nor_angular_momentum(turn, device):
    points = rough(neck(1.1 * core(), turn))
    speed, mass = kicked(points, device)
    # The law sees places in single precision.
    seen = points.astype(np.float32).astype(np.float64)
    push = mass[:, None] * speed
    size = np.linalg.norm(push, axis=1).sum()
    assert size > 0.0
    assert np.abs(push.sum(axis=0)).max() < 1e-6 * size
    assert np.abs(np.cross(seen - seen.mean(axis=0), push).sum(axis=0)).max() < 1e-6 * size * RADIUS


def test_the_law_does_not_see_where_the_neck_is_nor_how_it_lies():
    points = rough(neck(1.1 * core(), 1.5))
    turned = points[:, [1, 2, 0]] + [0.3, -0.2, 0.1]
    assert kicked(turned)[0] == pytest.approx(kicked(points)[0][:, [1, 2, 0]], abs=2e-3)


@pytest.mark.parametrize("turn", [2.0, 2.8])
def test_rings_turned_nearly_half_a_turn_are_pushed_out_and_unwound(turn):
    points = neck(1.2 * core(), turn)
    speed, _ = kicked(points)
    out, around = sideways(speed, points)
    ends = [TASK.ring(TASK.middle + k) for k in (-3, 3)]
    assert (out[np.concatenate(ends)] > 0.0).all()
    assert (around[ends[0]] > 0.0).all()
    assert (around[ends[1]] < 0.0).all()


def test_rings_that_come_too_near_are_pushed_apart():
    points = neck(1.05 * core(), 0.0)
    points[:, 0] = points[:, 0].mean() + 0.8 * (points[:, 0] - points[:, 0].mean())
    speed, _ = kicked(points)
    assert (speed[TASK.ring(TASK.middle - 3), 0] < 0.0).all()
    assert (speed[TASK.ring(TASK.middle + 3), 0] > 0.0).all()
    assert np.abs(speed[TASK.ring(TASK.middle), 0]).max() < 1e-6 * np.abs(speed).max()


def test_a_packed_vertex_that_passes_its_neighbour_is_drawn_back():
    points = neck(1.2 * core(), 0.0)
    own = TASK.ring(TASK.middle)
    points[own[5]] = 1.3 * points[own[6]] - 0.3 * points[own[5]]
    way = kicked(points)[0][own[5]]
    assert way @ (points[own[4]] - points[own[6]]) > 0.0


def test_the_balloons_of_a_maker_have_no_cores():
    scene = simulate_many([plan(Recipe.parse(BUBBLES))], device="cpu").model.scene
    assert scene.world_core.numpy().tolist() == [0, 0]


@pytest.mark.parametrize("device", DEVICES)
def test_a_wound_tube_gives_the_same_bits_alone_in_a_batch_and_by_one_block(device):
    def shaken(copies, blocks=0):
        scene = build_scene([tube_body(TASK)] * copies, range(copies), SceneSettings(dt=DT), device, 1, 1)
        scene.x.assign(np.tile(rough(neck(1.1 * core(), 1.0)), (copies, 1)).astype(np.float32))
        scene.touching.fill_(1)
        stepper = Stepper(scene, 16)
        if blocks and device != "cpu":
            stepper._sculptures.share_out(np.full(copies, blocks))
        stepper.advance(contact=True)
        return scene.x.numpy().reshape(copies, -1)

    alone = shaken(1)
    assert np.isfinite(alone).all()
    assert shaken(1, blocks=1).tobytes() == alone.tobytes()
    assert all(one.tobytes() == alone.tobytes() for one in shaken(3))
