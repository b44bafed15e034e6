"""V17: what is let go of neither speeds up nor begins to turn by itself, for a second and without air drag."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.simulation import simulate_many
from tests.verification.setups import Rig, momentum_of, tube

RADIUS, THICKNESS, AROUND = 4.5e-3, 0.18e-3, 12
NECK = 0.55 * RADIUS
WAVE_SPEED = 33.0
"""Slowest wave in the rubber of a 260, m/s: the measure of its speeds."""
DRIFT = 1e-6
"""Largest momentum gained in a second, in masses times wave speeds; angular momentum times the body's length."""
BUBBLE, STUB = 0.028, 0.012
"""Unstressed length of a bubble, and of the flat tube left at each of its ends, m."""


@pytest.fixture
def pinched():
    """A bubble between two closed necks with a stub of flat tube at each end, at rest."""
    stub, bubble = np.linspace(0.0, STUB, 5), np.linspace(STUB, STUB + BUBBLE, 15)
    stations = np.concatenate([stub[:-1], bubble, STUB + BUBBLE + stub[1:]])
    mesh = tube(RADIUS, AROUND, stations, parts=(4, 18))
    rig = Rig(mesh, rubber_named(), THICKNESS, gauge=(4.0e3, 7.0e3, 4.0e3), neck=NECK, substeps=20)
    x = mesh.points - [STUB + 0.5 * BUBBLE, 0.0, 0.0]
    place = np.abs(x[:, 0]) / (0.5 * BUBBLE)
    wide = 5.0 * np.sqrt(np.maximum(1.0 - place**4, 0.0))
    beyond = np.maximum(place - 1.0, 0.0) * 0.5 * BUBBLE
    x[:, 1:] *= np.where(place <= 1.0, 0.55 + wide, 1.0 - 0.45 * np.exp(-beyond / 3e-3))[:, None]
    x[:, 0] = np.sign(x[:, 0]) * (np.minimum(place, 1.0) * 3.5 * 0.5 * BUBBLE + beyond)
    rig.place(x)
    for chamber, pressure in enumerate((4.0e3, 6.5e3, 4.0e3)):
        rig.fill(chamber, pressure)
    rig.hands.radius[:] = rig.hands.radius_goal[:] = NECK
    rig.settle(most=2000)
    return rig


@pytest.mark.parametrize(
    "spin", [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.2, 0.2)], ids=["at rest", "about", "across"]
)
def test_a_pinched_bubble_that_shakes_keeps_its_momentum_and_its_spin(verify, pinched, spin):
    shake = np.random.default_rng(1).normal(size=pinched.points.shape) * 0.05
    velocity = shake + np.cross(spin, pinched.points - pinched.points.mean(axis=0))
    pinched.scene.v.assign(velocity.astype(np.float32))
    pinched.advance()
    push, turn = pinched.momentum()
    for _ in range(round(1.0 / (pinched.stepper.substeps * pinched.scene.settings.dt))):
        pinched.advance()
    pushed, turned = pinched.momentum()
    scale = pinched.array("mass").sum() * WAVE_SPEED
    name = f"pinched bubble, spin {spin[0]:g} {spin[1]:g} {spin[2]:g} rad/s"
    verify("V17", f"{name}, momentum", np.abs(pushed - push).max() / scale, 0.0, DRIFT)
    length = np.ptp(pinched.points[:, 0])
    verify("V17", f"{name}, angular momentum", np.abs(turned - turn).max() / (scale * length), 0.0, DRIFT)


LOCKED = """
format: 1
name: locked
units: cm
balloons:
  main: {size: 260, length: 20, tail: 6, color: red}
steps:
  - bubbles: {first: 6, second: 9, third: 9}
  - lock: [second, third]
    point: up
  - rest: tail
"""


def test_a_lock_twist_that_is_let_go_does_not_move_itself(verify):
    simulation = simulate_many([plan(Recipe.parse(LOCKED))], detail="draft", device="cpu")
    for frames in simulation.frames():
        assert isinstance(frames[0], Frame), frames[0]
    scene = simulation.model.scene
    # Nothing holds it any more, as what lies.
    simulation.model.hands.set_drag(0, 0.0)
    simulation.model.hands.touch([0])
    push, turn = momentum_of(scene)
    for _ in range(round(simulation.fps)):
        simulation.model.hands.upload()
        simulation.model.stepper.advance(contact=True)
        simulation.model.hands.arrived()
    pushed, turned = momentum_of(scene)
    scale = scene.mass.numpy().sum() * WAVE_SPEED
    length = np.ptp(scene.x.numpy(), axis=0).max()
    verify("V17", "lock twist let go, momentum", np.abs(pushed - push).max() / scale, 0.0, DRIFT)
    verify(
        "V17",
        "lock twist let go, angular momentum",
        np.abs(turned - turn).max() / (scale * length),
        0.0,
        DRIFT,
    )
