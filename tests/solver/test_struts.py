"""Struts, which keep the pose of welds."""

from __future__ import annotations

import numpy as np
import pytest

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
