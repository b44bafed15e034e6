"""Flow of gas between chambers: along which edges it goes, and what it leaves in the chambers."""

from __future__ import annotations

import numpy as np
import pytest
import warp as wp

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.kernels.arrays.latex import Chambers
from balloon_usd.solver.kernels.arrays.shared import State
from balloon_usd.solver.kernels.physics.gas import HIGHEST_PRESSURE, OPEN_PASSAGE
from balloon_usd.solver.simulation import simulate_many
from tests.verification.lone_kernels import balloon_gas

PAIR = """
format: 1
name: pair
units: cm
balloons:
  red: {size: 260, length: 25, tail: 8}
  blue: {size: 260, length: 14, tail: 5}
steps:
  - {bubbles: {a: 5, b: 5, c: 5}, balloon: red}
  - {bubbles: {d: 5}, balloon: blue}
"""
RED, BLUE = 6, 4
"""Segments of the balloons: lip and knot, bubbles and rest."""
SLIT = 1e-5
"""Open area of a closing neck, m2."""
STEP = 1e-5
"""Time step, s."""


@pytest.fixture
def model():
    made = simulate_many([plan(Recipe.parse(PAIR))], device="cpu").model
    made.hands.passage[:] = 0.0
    return made


def widen(model, **necks):
    """Set the open area of the necks behind some segments, m2."""
    behind = model.scene.end_joint.numpy()
    for name, area in necks.items():
        model.hands.passage[behind[int(name.removeprefix("behind_"))]] = area
    model.hands.passage_goal[:] = model.hands.passage
    model.hands.upload()


def flows(model):
    """Of every edge, the chambers that it leads from and to."""
    return list(
        zip(*(model.scene.arrays[name].numpy().tolist() for name in ("flow_from", "flow_to")), strict=True)
    )


def ends(model, segment):
    """Ends of edges at the chamber that a segment is the last of."""
    start = model.scene.chamber_end.numpy()
    return model.scene.flow_ends.numpy()[start[segment] : start[segment + 1]].tolist()


def step(model):
    """Advance the gas by a step; return how much every segment has gained, mol."""
    scene = model.scene
    before = scene.amount.numpy().copy()
    structs = [scene.arrays.struct(kind) for kind in (Chambers, State)]
    wp.launch(balloon_gas, dim=2, inputs=[scene.air, STEP, 1.0, *structs], device="cpu")
    return scene.amount.numpy() - before


def test_edges_lead_from_each_segment_of_a_balloon_to_its_next_one(model):
    widen(model)
    assert len(model.scene.segment_quad) == RED + BLUE
    assert flows(model) == [(s, s + 1) for s in range(RED + BLUE - 1) if s != RED - 1]
    assert model.scene.balloon_edge.numpy().tolist() == [0, RED - 1, RED + BLUE - 2]
    assert ends(model, 0) == [-1]
    assert ends(model, 3) == [3, -4]
    assert ends(model, RED - 1) == [RED - 1]
    assert ends(model, RED) == [-RED]


def test_segments_of_one_chamber_have_no_flow_among_them_and_its_edges_are_those_of_all(model):
    widen(model, behind_2=OPEN_PASSAGE, behind_3=OPEN_PASSAGE)
    assert flows(model)[:5] == [(0, 1), (1, 4), (4, 4), (4, 4), (4, 5)]
    assert ends(model, 4) == [2, -5]
    assert ends(model, 2) == ends(model, 3) == []


def test_gas_goes_from_a_full_chamber_through_a_slit_into_the_next_one(model):
    widen(model, behind_2=OPEN_PASSAGE, behind_3=SLIT)
    amount = model.scene.amount.numpy()
    amount[2:5] *= [1.2, 1.2, 1.0]
    gained = step(model)
    assert gained[3] < 0.0
    assert gained[4] == pytest.approx(-gained[3], rel=1e-9)
    assert not np.delete(gained, [3, 4]).any()


def test_gas_that_a_hand_pushes_goes_through_a_shut_neck_whatever_the_pressures(model):
    behind = model.scene.end_joint.numpy()
    model.hands.push_gas(behind[3], 2.0)
    widen(model)
    gained = step(model)
    assert gained[4] == pytest.approx(2.0 * STEP, rel=1e-6)
    assert gained[3] == pytest.approx(-2.0 * STEP, rel=1e-6)
    assert not np.delete(gained, [3, 4]).any()
    assert model.hands._goals()["blowing"].tolist() == [1, 0]


def test_a_hand_pushes_gas_for_one_frame_only(model):
    model.hands.push_gas(model.scene.end_joint.numpy()[3], 2.0)
    widen(model)
    names = ("x", "amount", "pressure", "volume")
    model.hands.begin_frame({name: model.scene.arrays[name].numpy() for name in names})
    widen(model)
    assert not step(model).any()


def test_an_edge_may_join_any_two_segments_of_a_balloon(model):
    widen(model, behind_2=SLIT)
    scene = model.scene
    amount = scene.amount.numpy()
    amount[2] *= 1.2
    # The edge behind segment 2, which led to 3, leads to 5.
    scene.flow_to.numpy()[2] = 5
    at = scene.flow_ends.numpy()
    start = scene.chamber_end.numpy()
    listed = [
        [e for e in at[start[s] : start[s + 1]].tolist() if (s, e) != (3, 3)] for s in range(RED + BLUE)
    ]
    listed[5].append(3)
    scene.flow_ends.assign(np.array([e for edges in listed for e in edges], dtype=np.int32))
    scene.chamber_end.assign(np.cumsum([0, *map(len, listed)]).astype(np.int32))
    gained = step(model)
    assert gained[2] < 0.0
    assert gained[5] == pytest.approx(-gained[2], rel=1e-9)
    assert not np.delete(gained, [2, 5]).any()


@pytest.mark.parametrize(
    ("left", "gauge"), [(1.0, 0.0), (0.5, 1.0), (0.1, 1.5e5 / 101325.0), (-0.1, 1.5e5 / 101325.0)]
)
def test_gas_pushes_back_what_is_squeezed_and_most_what_is_inside_out(model, left, gauge):
    scene = model.scene
    space = scene.volume.numpy()
    scene.amount.assign(scene.settings.atmosphere * space / float(scene.air.molar_energy))
    scene.volume.assign(np.float32(left) * space)
    scene.pressure.zero_()
    step(model)
    atmosphere = scene.settings.atmosphere
    assert scene.pressure.numpy()[1:RED] == pytest.approx(gauge * atmosphere, abs=1e-4 * atmosphere)
    assert scene.pressure.numpy().max() <= HIGHEST_PRESSURE * (1.0 + 1e-6)
