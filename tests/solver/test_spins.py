"""Spins: which vertices turn in a frame, about which axis, and what they do on the device."""

from __future__ import annotations

import numpy as np
import pytest
import warp as wp

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.kernels.arrays.latex import Rubber
from balloon_usd.solver.kernels.arrays.shared import Balloons, Hands, Mesh, State
from balloon_usd.solver.latex.spins import Spins, VertexSet
from balloon_usd.solver.rotations import rotation
from balloon_usd.solver.simulation import simulate_many
from tests.solver.spin_kernels import step_freely

CHAIN = "format: 1\nname: c\nunits: cm\nballoons: {main: {size: 260, length: 14, tail: 5}}\nsteps: [bubbles: {a: 8}]\n"
STEP = 0.5
"""Time step, s: long, so that all turn far."""
FIELDS = {"point": (0.0, 0.0, 0.0), "axis": (1.0, 0.0, 0.0), "rate": 2.0}


def some(*indices):
    return VertexSet.of(np.array(indices))


@pytest.fixture
def model():
    return simulate_many([plan(Recipe.parse(CHAIN))], device="cpu").model


@pytest.fixture
def spins(model):
    return Spins(model.scene)


def turning(spins):
    return np.flatnonzero(spins.of_vertex).tolist()


def test_one_run_of_vertices_is_a_slice():
    assert some(3, 4, 5).indices == slice(3, 6)
    assert some(5, 3).indices.tolist() == [3, 5]
    assert some(4, 5, 3).indices == slice(3, 6)
    assert VertexSet.of(np.zeros(0, dtype=np.int64)).indices.tolist() == []


def test_vertices_change_only_when_other_sets_turn(spins):
    first, second = some(1, 2), some(7, 9)
    assert not spins.settle()
    for begun in (True, False, False):
        spins.stop()
        spins.turn(first, FIELDS)
        assert spins.settle() == begun
        assert turning(spins) == [1, 2]
    spins.turn(second, FIELDS | {"rate": 3.0})
    assert spins.settle()
    assert turning(spins) == [1, 2, 7, 9]
    assert spins.rows["rate"][spins.of_vertex[[1, 7]] - 1] == pytest.approx([2.0, 3.0])
    spins.stop()
    assert spins.settle()
    assert turning(spins) == []


def test_a_set_that_stops_leaves_the_others_as_they_were(spins):
    whole, part = some(1, 2, 3), some(2)
    spins.turn(whole, FIELDS)
    spins.turn(part, FIELDS | {"rate": 3.0})
    spins.settle()
    assert spins.rows["rate"][spins.of_vertex[[1, 2, 3]] - 1] == pytest.approx([2.0, 3.0, 2.0])
    spins.stop()
    spins.turn(whole, FIELDS)
    spins.settle()
    assert spins.rows["rate"][spins.of_vertex[[1, 2, 3]] - 1] == pytest.approx([2.0, 2.0, 2.0])


def test_rows_that_no_longer_turn_are_used_again_and_no_more_than_there_are(spins):
    room = len(spins.rows)
    for _ in range(2):
        spins.stop()
        for k in range(room):
            spins.turn(some(k), FIELDS)
        assert spins.settle()
    spins.turn(some(room), FIELDS)
    with pytest.raises(ValueError, match=f"{room + 1} spins but room for {room}"):
        spins.settle()


def test_sets_of_one_balloon_turn_each_about_its_own_axis_and_point(model):
    scene, hands = model.scene, model.hands
    for name in ("gravity", "drag"):
        scene.arrays[name].zero_()
    random = np.random.default_rng(1)
    x, v = (random.normal(scale=0.1, size=(len(scene.x), 3)).astype(np.float32) for _ in range(2))
    scene.x.assign(x)
    scene.v.assign(v)
    held = {"point": (0.1, 0.0, 0.2), "axis": (0.0, 0.6, 0.8), "rate": 3.0}
    free = {
        "point": (0.0, -0.1, 0.0),
        "axis": (1.0, 0.0, 0.0),
        "rate": -2.0,
        "drift": (0.1, 0.0, 0.3),
        "free": 1,
    }
    sets = np.arange(4, 40), np.array([50, 52, 57])
    for vertices, spin in zip(sets, (held, free), strict=True):
        hands.spins.turn(VertexSet.of(vertices), spin)
    hands.drag[:] = 0.0
    hands.upload()
    structs = [scene.arrays.struct(kind) for kind in (Mesh, Balloons, Rubber, Hands, State)]
    wp.launch(step_freely, dim=len(x), inputs=[STEP, *structs], device="cpu")
    wanted, speed = x + STEP * v, v.copy()
    for vertices, spin in zip(sets, (held, free), strict=True):
        turn = rotation(STEP * spin["rate"] * np.array(spin["axis"]))
        shift = STEP * np.array(spin.get("drift", np.zeros(3)))
        wanted[vertices] = spin["point"] + (wanted[vertices] - spin["point"]) @ turn.T + shift
        speed[vertices] = v[vertices] if "free" in spin else v[vertices] @ turn.T
    assert scene.x.numpy() == pytest.approx(wanted, abs=1e-6)
    assert scene.v.numpy() == pytest.approx(speed, abs=1e-6)


def test_the_device_has_the_spins_of_a_frame_and_none_afterwards(model):
    vertices = some(4, 8)
    model.hands.spins.turn(vertices, FIELDS)
    model.hands.upload()
    assert np.flatnonzero(model.scene.vertex_spin.numpy()).tolist() == [4, 8]
    row = int(model.scene.vertex_spin.numpy()[4]) - 1
    assert model.scene.spins.numpy()[row]["rate"] == pytest.approx(2.0)
    model.hands.spins.stop()
    model.hands.upload()
    assert not model.scene.vertex_spin.numpy().any()
