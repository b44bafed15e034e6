"""V11: the pinched bubble, alone and at rest, and three of them twisted off a balloon one after the other."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from balloon_usd.balloon.bubble_shape import (
    bubble_of_length,
    neck_rubber,
    tail_volume_per_rest_length,
    tube_volume_per_rest_length,
)
from balloon_usd.balloon.detail import detail_named
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_mesh import ring_stations
from balloon_usd.balloon.tube_theory import gauge_pressure, maxwell_state
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.body import NECK_RADIUS
from balloon_usd.solver.simulation import simulate_many
from tests.verification.free_fingers import free_fingers
from tests.verification.setups import Rig, at_energy_of, polygon_factor, ring_stretches, stretched, tube

SIZE, LATEX = size_named("260"), rubber_named()
STATE = maxwell_state(LATEX)
PRESSURE = gauge_pressure(SIZE, STATE.p_star)
NECK = NECK_RADIUS * SIZE.radius
TABLE = {30: (37.0, 23.2, 9.31), 50: (46.7, 63.7, 9.22), 90: (50.5, 145.7, 9.21)}
"""Length, mm: diameter, mm; gas, mL; flat tail that its twist fills, mm."""
CLOSING = 60
"""Frames of the rig in which the necks are closed."""
HIDDEN = 2.0e-4
"""Movement, in radii, below which a bubble is at rest: a change of its volume by less than 0.01 %."""


def rest_stations(length, detail):
    """Unstressed places of the rings of a bubble as a balloon's mesh has them, without the necks' rubber,
    m.
    """
    rest, before = bubble_of_length(SIZE, LATEX, length).rest_length, 0.03
    stations = ring_stations(detail, SIZE, (before, before + rest)) - before
    inside = stations[(stations > -1e-9) & (stations < rest + 1e-9)]
    hidden = neck_rubber(SIZE, LATEX, rest, NECK * math.cos(math.pi / detail.around))
    return inside * (1.0 - 2.0 * hidden / rest)


@cache
def pinched(length, level):
    """Pinch a bulged tube at both ends, under the Maxwell pressure; return length, diameter (m) and gas
    (m3).
    """
    detail = detail_named(level)
    mesh = tube(SIZE.radius, detail.around, rest_stations(length, detail))
    rig = Rig(mesh, LATEX, SIZE.thickness, gauge=(0.0, PRESSURE, 0.0), vented=(0, 1, 2), neck=NECK)
    rig.place(stretched(mesh, STATE.bulged.a, STATE.bulged.b))
    at_energy_of(rig, STATE.bulged)
    wide = STATE.bulged.a * SIZE.radius / math.cos(math.pi / detail.around)
    rig.hands.radius[:] = wide
    for frame in range(1, CLOSING + 1):
        rig.hands.radius_goal[:] = NECK + (wide - NECK) * (1.0 + math.cos(math.pi * frame / CLOSING)) / 2.0
        rig.advance()
    rig.settle(HIDDEN, most=2000)
    ends = [rig.points[f : f + n].mean(axis=0) for f, n in (mesh.mesh_rings[0], mesh.mesh_rings[-1])]
    widest = 2.0 * SIZE.radius * float(ring_stretches(rig)[0].max())
    return (
        float(np.linalg.norm(ends[1] - ends[0])),
        widest,
        rig.array("volume")[1] / polygon_factor(detail.around),
    )


@pytest.mark.parametrize(
    ("length", "level"), [(30, "full"), (50, "full"), (90, "full"), (50, "draft"), (90, "draft")]
)
def test_a_pinched_bubble_has_the_length_the_width_and_the_gas_of_theory(verify, length, level):
    diameter, volume, _ = TABLE[length]
    found = pinched(length * 1e-3, level)
    verify("V11", f"bubble of {length} mm, {level}, length, mm", found[0] * 1e3, length, 2e-2)
    verify("V11", f"bubble of {length} mm, {level}, diameter, mm", found[1] * 1e3, diameter, 2e-2)
    verify("V11", f"bubble of {length} mm, {level}, gas, mL", found[2] * 1e6, volume, 3e-2)


@pytest.mark.parametrize("length", [30, 50, 90])
def test_a_pinch_pushes_out_the_gas_that_fills_nine_millimetres_of_tail(verify, length):
    rest = bubble_of_length(SIZE, LATEX, length * 1e-3).rest_length
    tube_gas = tube_volume_per_rest_length(SIZE, LATEX)
    gained = tube_gas - tail_volume_per_rest_length(SIZE, LATEX)
    used = (tube_gas * rest - pinched(length * 1e-3, "full")[2]) / gained
    verify("V11b", f"flat tail for a bubble of {length} mm, mm", used * 1e3, TABLE[length][2], 5e-2)


THREE = """
format: 1
name: three
units: cm
balloons:
  main: {size: 260, length: 20, tail: 6, color: red}
steps:
  - bubbles: {first: LENGTH, second: LENGTH, third: LENGTH}
  - rest: tail
  - wait: 2
physics: {hold: 0}
"""


def front(simulation, frame):
    """Unstressed place of the bulge's front, where the hoop stretch is midway between the phases, m."""
    mesh = simulation.meshes[0][0]
    rings = frame.points[0][mesh.ring_start[:, None] + np.arange(mesh.around)].astype(float)
    girth = np.linalg.norm(rings - np.roll(rings, 1, axis=1), axis=2).sum(axis=1)
    hoop = girth / (2.0 * mesh.around * np.tan(np.pi / mesh.around) * SIZE.radius)
    midway = 0.5 * (STATE.thin.a + STATE.bulged.a)
    last = int(np.flatnonzero(hoop > midway)[-1])
    share = (hoop[last] - midway) / (hoop[last] - hoop[last + 1])
    return mesh.ring_along[last] + share * (mesh.ring_along[last + 1] - mesh.ring_along[last])


@pytest.fixture(scope="module", params=[(10, "draft"), (10, "preview"), (5, "draft")], ids=str)
def three(request):
    """Three bubbles of one length: which, the gas that they hold and should hold (m3), and the flat tail
    that their twists have filled (m).
    """
    length, level = request.param
    made = plan(Recipe.parse(THREE.replace("LENGTH", str(length))))
    simulation = simulate_many([made], detail=level, device="cpu")
    before = frame = None
    with free_fingers():
        for frames in simulation.frames():
            if frames[0].doing.startswith("comes undone"):
                break
            frame = frames[0]
            if frame.doing.startswith("inflate"):
                before = frame
    gas = frame.volume[:3].astype(float) / polygon_factor(simulation.meshes[0][0].around)
    used = front(simulation, frame) - front(simulation, before)
    return f"bubbles of {length} cm, {level}", gas, made.strips["main"].bubbles[0].volume, used


def test_three_bubbles_of_one_length_hold_the_gas_of_theory_and_of_each_other(verify, three):
    name, gas, theory, _ = three
    for place, found in zip(("first", "second", "third"), gas, strict=True):
        verify("V11", f"{place} of three {name}, gas, mL", found * 1e6, theory * 1e6, 3e-2)
    verify("V11", f"three {name}, largest over smallest", gas.max() / gas.min(), 1.0, 3e-2)


def test_every_twist_fills_about_nine_millimetres_of_flat_tail(verify, three):
    name, _, _, filled = three
    used = filled / 3.0
    assert 5e-3 < used < 15e-3
    verify("V11b", f"{name}, flat tail for each twist, mm", used * 1e3, 9.2, 5e-2)
