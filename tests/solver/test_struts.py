"""Struts, which keep the pose of welds."""

from __future__ import annotations

from collections import Counter
from itertools import chain
from pathlib import Path

import numpy as np
import pytest

from balloon_usd.operations.moves import LetGo, Pinch, Weld
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.latex.struts import CROWD
from balloon_usd.solver.simulation import simulate_many
from tests.solver.test_motions import Room


@pytest.fixture
def room():
    return Room()


def put(room, pair, far):
    """Ask for a strut between two joints that are so far apart (m), and return what the device has of it."""
    struts, (a, b) = room.sculpture.struts, pair
    room.middle[b] = room.middle[a] + (far, 0.0, 0.0)
    struts.hold({pair})
    struts.put(room.middle)
    at, scene = struts.pairs[pair], room.model.scene
    return float(scene.strut_length.numpy()[at]), float(scene.strut_stiffness.numpy()[at])


def test_a_strut_keeps_its_length_however_often_it_is_asked_for(room):
    pair = room.joint("nose.end"), room.joint("right.end")
    length, stiffness = put(room, pair, 0.1)
    assert length == pytest.approx(0.1)
    assert stiffness > 0.0
    assert put(room, pair, 0.3) == (length, stiffness)


def test_a_loosened_strut_holds_nothing_until_it_is_asked_for_at_a_new_length(room):
    pair, other = (room.joint("nose.end"), room.joint("right.end")), (room.joint("nose.end"), 0)
    struts, scene = room.sculpture.struts, room.model.scene
    before = put(room, other, 0.2)
    _, stiffness = put(room, pair, 0.1)
    struts.loosen(set(pair))
    assert scene.strut_stiffness.numpy()[struts.pairs[pair]] == 0.0
    assert put(room, pair, 0.3) == (pytest.approx(0.3), stiffness)
    assert put(room, other, 0.4) == before
    assert np.count_nonzero(scene.strut_stiffness.numpy()) == 2


def test_struts_that_crowd_at_one_joint_share_what_it_bears(room):
    pair = room.joint("nose.end"), room.joint("right.end")
    alone = put(room, pair, 0.1)[1]
    crowded = Room()
    for _ in range(2 * CROWD):
        crowded.sculpture.struts.expect({pair})
    assert put(crowded, pair, 0.1)[1] == pytest.approx(0.5 * alone)


def test_a_net_has_room_for_all_the_struts_that_its_welds_come_to_need():
    path = Path(__file__).parents[2] / "recipes/book/icosahedron_centre.yaml"
    model = simulate_many([plan(Recipe.load(path))], device="cpu").model
    sculpture, hands = model.performers[0].sculpture, model.hands
    middle = np.zeros((len(hands.mode), 3), dtype=np.float32)
    for move in sculpture.plan.choreography.moves:
        if isinstance(move, Pinch):
            hands.radius_goal[sculpture.joints[move.ring]] = 0.001
        elif isinstance(move, Weld):
            hands.weld(tuple(sculpture.joints[ring] for ring in move.rings))
        elif isinstance(move, LetGo):
            sculpture.struts.hold(sculpture.friction.pairs(hands))
            sculpture.struts.put(middle)
    ends = Counter(chain.from_iterable(sculpture.struts.pairs))
    assert max(ends.values()) == model.scene.joint_struts.shape[1] == 35
