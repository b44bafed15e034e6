"""Where a ring has frozen, air and faces belong to the bubble on their side (Kosaka 2008, 3.6)."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.kosaka.model import KosakaModel
from tests.solver.kosaka_bench import DEVICES
from tests.solver.kosaka_scenes import borders, filled, freeze, place_of, small_plan

NECK = 0.004
"""Radius at a ring that is drawn together, m."""
ROUND = 0.012
"""How far from a ring the wall narrows, m."""


def narrowed(model: KosakaModel, joint: int) -> None:
    """Draw the wall at a ring together, and the air with it."""
    place = place_of(model, joint)
    for array in (model.scene.x, model.scene.air):
        points = array.numpy()
        near = np.clip(np.abs(points[:, 0] - place) / ROUND, 0.0, 1.0)
        narrow = NECK / np.abs(small_plan()[1].points[:, 1]).max()
        points[:, 1:] *= (narrow + (1.0 - narrow) * np.sqrt(near * (2.0 - near)))[:, None]
        array.assign(points)


def sides(points: np.ndarray, places: list[float]) -> np.ndarray:
    """Number of rings that points lie beyond."""
    return np.searchsorted(np.sort(places), points[:, 0])


def face_places(model: KosakaModel) -> np.ndarray:
    return model.scene.x.numpy()[model.scene.quads.numpy()].mean(axis=1)


def clusters(model: KosakaModel) -> tuple[np.ndarray, np.ndarray]:
    """Of air and faces; what the model tells and what is on the device must agree."""
    air, faces = model.scene.air_cluster.numpy().copy(), model.scene.quad_cluster.numpy().copy()
    assert np.array_equal(air, model.clusters.of_air)
    return air, faces


@pytest.mark.parametrize("device", DEVICES)
def test_an_undivided_balloon_is_one_cluster(device):
    air, faces = clusters(filled(device, seed=51))
    assert len(np.unique(np.concatenate([air, faces]))) == 1


@pytest.mark.parametrize("device", DEVICES)
def test_nothing_is_parted_while_no_ring_has_frozen(device):
    model = filled(device, seed=52)
    before = clusters(model)
    freeze(model)
    assert all(map(np.array_equal, before, clusters(model)))


@pytest.mark.parametrize("neck", [False, True], ids=["straight", "drawn together"])
@pytest.mark.parametrize("border", [0, 1])
@pytest.mark.parametrize("device", DEVICES)
def test_after_parting_everything_belongs_to_the_bubble_on_its_side(device, border, neck):
    model = filled(device, seed=53)
    joint = borders(model)[border]
    place = place_of(model, joint)
    if neck:
        narrowed(model, joint)
    whole = clusters(model)[0][0]
    freeze(model, joint)
    air, faces = clusters(model)
    beyond = sides(model.scene.air.numpy(), [place]) == 1
    assert 0.2 < beyond.mean() < 0.8
    assert np.array_equal(air, np.where(beyond, whole + border + 1, whole))
    assert np.array_equal(faces, np.where(sides(face_places(model), [place]) == 1, whole + border + 1, whole))


@pytest.mark.parametrize("order", [(0, 1), (1, 0)], ids=["from the start", "from the end"])
@pytest.mark.parametrize("device", DEVICES)
def test_bubbles_come_out_the_same_in_whatever_order_they_are_parted(device, order):
    model = filled(device, seed=54)
    joints = borders(model)
    places = [place_of(model, joint) for joint in joints]
    for k in order:
        freeze(model, joints[k])
    air, faces = clusters(model)
    assert np.array_equal(air - air.min(), sides(model.scene.air.numpy(), places))
    assert np.array_equal(faces - faces.min(), sides(face_places(model), places))
    at_once = filled(device, seed=54)
    freeze(at_once, *joints)
    assert all(map(np.array_equal, (air, faces), clusters(at_once)))


@pytest.mark.parametrize("device", DEVICES)
def test_parting_one_balloon_leaves_another_whole(device):
    model = filled(device, seed=55, copies=2)
    before = clusters(model)
    freeze(model, borders(model, body=1)[0])
    air, faces = clusters(model)
    particles, quads = int(model.scene.air_start[1]), int(model.scene.quad_start[1])
    assert np.array_equal(air[:particles], before[0][:particles])
    assert np.array_equal(faces[:quads], before[1][:quads])
    assert len(np.unique(air[particles:])) == len(np.unique(faces[quads:])) == 2


@pytest.mark.parametrize("device", DEVICES)
def test_what_was_parted_stays_parted(device):
    model = filled(device, seed=56)
    first, second = borders(model)
    freeze(model, first)
    air, _ = clusters(model)
    # Air that is carried past the ring later still belongs to its bubble.
    model.scene.air.assign(model.scene.air.numpy()[::-1].copy())
    freeze(model, second)
    again, _ = clusters(model)
    assert np.array_equal(again == air.min(), air == air.min())
