"""Lists of neighbours miss nobody who may meet before the next search, and come out the same every time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
import warp as wp

from balloon_usd.solver.kernels.kosaka.offset_regions import WIDER, WIDER_OUTSIDE
from balloon_usd.solver.kosaka.model import KosakaModel
from tests.solver import kosaka_reference as thesis
from tests.solver.kosaka_bench import DEVICES, lanes_on, members
from tests.solver.kosaka_scenes import AROUND, FINE, scatter, small_model

BEYOND = 0.006
"""How far outside the wall air is put, m: the leak test must find it."""
FAR = 1.0
"""A place where there is nothing, m."""
HALF = 0.499
"""How far everything moves until the next search, in margins."""
LISTS = (
    ("neighbour_count", "neighbours"),
    ("air_face_count", "air_faces"),
    ("face_air_count", "face_air"),
)


@dataclass(frozen=True)
class Listed:
    """Who is listed with whom, as matrices."""

    air_air: np.ndarray
    """(P, P)"""
    air_face: np.ndarray
    """Triangles of every particle, (P, T)."""
    quad_air: np.ndarray
    """Particles of every quad, (Q, P)."""


def search(model: KosakaModel) -> list[list[np.ndarray]]:
    """All lists as they stand, in their order."""
    model.stepper._find_neighbours(contact=False)
    scene = model.scene
    return [
        members(scene.arrays[count].numpy(), scene.arrays[table].numpy(), scene.device)
        for count, table in LISTS
    ]


def matrices(model: KosakaModel) -> Listed:
    particles, faces = len(model.scene.air), len(model.scene.face_normal)
    made = []
    for lists, columns in zip(search(model), (particles, faces, particles), strict=True):
        matrix = np.zeros((len(lists), columns), dtype=bool)
        for row, others in zip(matrix, lists, strict=True):
            assert len(set(others)) == len(others)
            row[others] = True
        made.append(matrix)
    return Listed(*made)


def meetings(model: KosakaModel, x, air) -> Listed:
    """Who is within reach of whom, and in whose regions; quads mind only what is inside."""
    scene, law = model.scene, model.scene.bodies[0].parameters
    cluster, faces = scene.air_cluster.numpy(), np.repeat(scene.quad_cluster.numpy(), 2)
    close = (thesis.length(air[:, None] - air) < law.re) & (cluster[:, None] == cluster)
    np.fill_diagonal(close, val=False)
    _, d, uvw = thesis.regions(thesis.triangles_of(scene.quads.numpy()), x, air)
    region = (d > -law.air_offset) & (d < law.leak_offset) & (faces[:, None] == cluster)
    region &= uvw.min(axis=2) > np.where(d < 0.0, -WIDER, -WIDER_OUTSIDE)
    inside = region & (d < 0.0)
    return Listed(close, region.T, inside[::2] | inside[1::2])


def directions(random: np.random.Generator, count: int) -> np.ndarray:
    d = random.normal(size=(count, 3))
    return d / thesis.length(d)[:, None]


def split(model: KosakaModel) -> None:
    """Give what lies beyond the middle a cluster of its own."""
    scene = model.scene
    middle = 0.06
    air, quads = scene.air.numpy(), scene.x.numpy()[scene.quads.numpy()].mean(axis=1)
    scene.air_cluster.assign((air[:, 0] > middle).astype(np.int32))
    scene.quad_cluster.assign((quads[:, 0] > middle).astype(np.int32))


MOTIONS = {
    "nothing": lambda random, x: np.zeros_like(x),
    "everything": lambda random, x: directions(random, 1),
    "a bending wall": lambda random, x: np.sin(x[:, :1] * 2.0 * np.pi / 0.05) * directions(random, 1),
}
"""How the wall moves, in the furthest way; the air moves every particle by itself."""


@pytest.mark.parametrize(
    ("motion", "around"),
    [("nothing", AROUND), ("everything", AROUND), ("a bending wall", AROUND), ("everything", FINE)],
)
@pytest.mark.parametrize("device", DEVICES)
def test_nobody_meets_anybody_unlisted_before_the_next_search(device, motion, around):
    model = small_model(device, around=around)
    scatter(model.scene, seed=41, beyond=BEYOND)
    split(model)
    lists = matrices(model)
    random = np.random.default_rng(42)
    step = HALF * model.scene.margin
    x, air = (model.scene.arrays[name].numpy().astype(float) for name in ("x", "air"))
    x += step * MOTIONS[motion](random, x)
    if motion != "nothing":
        air += step * directions(random, len(air))
    for kind, needed in vars(meetings(model, x, air)).items():
        assert needed.sum() > len(air) // 2
        assert not (needed & ~vars(lists)[kind]).any(), kind


@pytest.mark.parametrize("device", DEVICES)
def test_lists_of_air_agree_with_each_other_and_with_those_of_faces(device):
    model = small_model(device)
    scatter(model.scene, seed=43, beyond=BEYOND)
    lists = matrices(model)
    assert np.array_equal(lists.air_air, lists.air_air.T)
    of_quads = lists.air_face[:, ::2] | lists.air_face[:, 1::2]
    # A quad leaves out what is outside it.
    assert not (lists.quad_air.T & ~of_quads).any()


@pytest.mark.parametrize("device", DEVICES)
def test_nobody_is_listed_with_another_cluster(device):
    model = small_model(device)
    scatter(model.scene, seed=44, beyond=BEYOND)
    split(model)
    lists = matrices(model)
    air, quads = model.scene.air_cluster.numpy(), model.scene.quad_cluster.numpy()
    assert not lists.air_air[air[:, None] != air].any()
    assert not lists.air_face[air[:, None] != np.repeat(quads, 2)].any()
    assert not lists.quad_air[quads[:, None] != air].any()


def same(ones: list[list[np.ndarray]], others: list[list[np.ndarray]]) -> bool:
    """Whether lists are the same in the same order."""
    return all(
        len(one) == len(other) and all(map(np.array_equal, one, other))
        for one, other in zip(ones, others, strict=True)
    )


@pytest.mark.parametrize("device", DEVICES)
def test_two_searches_give_the_same_lists_in_the_same_order(device):
    model, other = small_model(device), small_model(device)
    for each in (model, other):
        scatter(each.scene, seed=45)
    first = search(model)
    assert same(first, search(model))
    assert same(first, search(other))


@pytest.mark.parametrize("device", DEVICES)
def test_a_balloon_is_listed_alike_alone_and_in_a_batch(device):
    alone, batch = small_model(device), small_model(device, copies=2)
    for model in (alone, batch):
        scatter(model.scene, seed=46)
    wanted = search(alone)
    assert same(wanted, [found[: len(lists)] for found, lists in zip(search(batch), wanted, strict=True)])


@pytest.mark.parametrize("device", DEVICES)
def test_a_sculpture_goes_on_while_there_is_room(device):
    model = small_model(device)
    scatter(model.scene, seed=47)
    search(model)
    model.read_back()
    assert model.failures() == {}


@pytest.mark.parametrize("small", range(len(LISTS)), ids=[table for _, table in LISTS])
@pytest.mark.parametrize("device", DEVICES)
def test_a_sculpture_in_which_somebody_finds_no_room_fails(device, small):
    model = small_model(device, copies=2)
    scene, table = model.scene, LISTS[small][1]
    scatter(scene, seed=48)
    whole = search(model)
    rows = len(scene.arrays[table])
    scene.arrays[table] = wp.zeros((rows, lanes_on(device)), dtype=int, device=device)
    # The second balloon is left with so little air that nobody is near.
    air = scene.air.numpy()
    air[scene.air_start[1] :] = FAR + np.arange(len(air) - scene.air_start[1])[:, None]
    scene.air.assign(air)
    cut = search(model)
    assert scene.most_near.numpy()[0] > 0
    assert all(
        set(few) <= set(all_) for few, all_ in zip(cut[small][: rows // 2], whole[small], strict=False)
    )
    model.read_back()
    assert list(model.failures()) == [0]
    assert "space them wider" in model.failures()[0]
