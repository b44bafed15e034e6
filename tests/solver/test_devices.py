"""Devices: each gives the same bits again, whoever else is made beside, and all make the same sculpture."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import warp as wp

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many
from tests.joints import joint_distances
from tests.solver.bits import bits

RECIPE = """
format: 1
name: ears
units: cm
fps: 16
balloons:
  main: {{size: 260, length: {length:g}, tail: 4, color: red}}
steps:
  - bubbles: {{nose: 3, left_ear: 4, right_ear: 4}}
    seconds: 1.2
  - lock: [left_ear, right_ear]
    point: up
  - rest: tail
physics: {{hold: 0.2, substeps: {substeps}}}
"""
DEVICES = ["cpu", *(device.alias for device in wp.get_cuda_devices())]
"""Where simulations can run on this machine."""
ROUGH = 28
"""Substeps in a frame where only bits matter: with fewer, the hands would be too fast."""
JOINTS_APART = 1.5e-3
"""Largest difference of a distance between joints from that on the CPU, m."""
GAS_APART = 0.01
"""Largest difference of the volume of a bubble from that on the CPU, as a share."""


def ears(length=7.5, substeps=150):
    """The plan of a nose and two ears."""
    return plan(Recipe.parse(RECIPE.format(length=length, substeps=substeps)))


def frames_of(simulation):
    """All frames of the first sculpture, whose ears press on each other in the end."""
    frames = [first for first, *_ in simulation.frames()]
    assert frames[-1].contact.max() > 0.0
    return frames


@cache
def made(device):
    """All frames of one run on a device, and the distances between joints in the last."""
    simulation = simulate_many([ears()], device=device)
    frames = frames_of(simulation)
    return frames, joint_distances(simulation, frames[-1])


@pytest.mark.parametrize("runs", [2, pytest.param(10, marks=pytest.mark.long)])
@pytest.mark.parametrize("device", DEVICES)
def test_all_runs_give_the_same_bits_in_every_frame(device, runs):
    expected = [bits(frame) for frame in made(device)[0]]
    for _ in range(runs - 1):
        again = frames_of(simulate_many([ears()], device=device))
        assert [bits(frame) for frame in again] == expected


@pytest.mark.parametrize("batch", [5, pytest.param(64, marks=pytest.mark.long)])
@pytest.mark.parametrize("device", DEVICES)
def test_a_sculpture_has_the_same_bits_alone_and_among_many(device, batch, monkeypatch):
    # In one flat state on every device.
    monkeypatch.setattr("balloon_usd.solver.simulation.usable_cores", lambda: 1)
    alone = frames_of(simulate_many([ears(substeps=ROUGH)], device=device))
    places = (0, batch // 2 - 1, batch - 1)
    plans = [ears(7.5 if k in places else 7.51 + 0.01 * k, ROUGH) for k in range(batch)]
    together = simulate_many(plans, device=device).frames()
    for expected in alone:
        outcomes = next(together)
        assert all(bits(outcomes[k]) == bits(expected) for k in places), f"frame {expected.time_code}"
    assert bits(outcomes[batch // 2]) != bits(expected)


@pytest.mark.parametrize("device", DEVICES)
def test_every_device_makes_the_same_sculpture_as_the_cpu(device):
    (frames, distances), (on_cpu, on_cpu_distances) = made(device), made("cpu")
    apart = np.abs(distances - on_cpu_distances).max()
    assert apart < JOINTS_APART, f"{1e3 * apart:.2f} mm"
    gas = np.abs(frames[-1].volume / on_cpu[-1].volume - 1.0)
    assert gas.max() < GAS_APART, f"{gas.max():.2%}"
