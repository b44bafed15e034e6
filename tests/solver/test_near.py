"""Lists of neighbours miss nobody who may meet before the next search, and come out the same every time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
import warp as wp

from balloon_usd.solver.kernels.offsets import WIDER, WIDER_OUTSIDE
from balloon_usd.solver.kosaka.model import KosakaModel
from tests.solver import kosaka_reference as thesis
from tests.solver.kosaka_bench import DEVICES
from tests.solver.kosaka_scenes import scatter, small_model, small_plan

BEYOND = 0.006
"""How far outside the wall air is put, m: the leak test must find it."""
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
    air_face: np.ndarray
    face_air: np.ndarray


def search(model: KosakaModel) -> Listed:
    model.stepper._find_neighbours()
    arrays = model.scene.arrays
    particles, faces = len(arrays["air"]), len(arrays["face_normal"])
    matrices = []
    for (count, members), columns in zip(LISTS, (particles, faces, particles), strict=True):
        matrix = np.zeros((len(arrays[count]), columns), dtype=bool)
        for row, (n, others) in enumerate(zip(arrays[count].numpy(), arrays[members].numpy(), strict=True)):
            assert len(set(others[:n])) == n
            matrix[row, others[:n]] = True
        matrices.append(matrix)
    return Listed(*matrices)


def bits(model: KosakaModel) -> list[np.ndarray]:
    """All lists as they stand, in their order."""
    model.stepper._find_neighbours()
    arrays = model.scene.arrays
    rows = []
    for count, members in LISTS:
        rows += [others[:n] for n, others in zip(arrays[count].numpy(), arrays[members].numpy(), strict=True)]
    return rows


def meetings(model: KosakaModel, x, air) -> tuple[np.ndarray, np.ndarray]:
    """Who is within reach of whom, (P, P), and which particles are in which triangles' regions, (P, T)."""
    scene, law = model.scene, model.scene.bodies[0].parameters
    cluster, faces = scene.air_cluster.numpy(), np.repeat(scene.quad_cluster.numpy(), 2)
    close = thesis.length(air[:, None] - air) < law.re
    np.fill_diagonal(close, val=False)
    _, d, uvw = thesis.regions(thesis.triangles_of(scene.quads.numpy()), x, air)
    region = (d > -law.air_offset) & (d < law.leak_offset)
    region &= uvw.min(axis=2) > np.where(d < 0.0, -WIDER, -WIDER_OUTSIDE)
    return close & (cluster[:, None] == cluster), (region & (faces[:, None] == cluster)).T


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


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("device", DEVICES)
def test_nobody_meets_anybody_unlisted_before_the_next_search(device, motion):
    model = small_model(device)
    scatter(model.scene, seed=41, beyond=BEYOND)
    split(model)
    listed = search(model)
    random = np.random.default_rng(42)
    step = HALF * model.scene.margin
    x, air = (model.scene.arrays[name].numpy().astype(float) for name in ("x", "air"))
    x += step * MOTIONS[motion](random, x)
    if motion != "nothing":
        air += step * directions(random, len(air))
    close, region = meetings(model, x, air)
    assert close.sum() > len(air)
    assert region.sum() > len(air)
    assert not (close & ~listed.air_air).any()
    assert not (region & ~listed.air_face).any()


@pytest.mark.parametrize("device", DEVICES)
def test_lists_of_air_and_of_faces_agree(device):
    model = small_model(device)
    scatter(model.scene, seed=43, beyond=BEYOND)
    listed = search(model)
    assert np.array_equal(listed.air_face, listed.face_air.T)
    assert np.array_equal(listed.air_air, listed.air_air.T)


@pytest.mark.parametrize("device", DEVICES)
def test_nobody_is_listed_with_another_cluster(device):
    model = small_model(device)
    scatter(model.scene, seed=44, beyond=BEYOND)
    split(model)
    listed = search(model)
    cluster = model.scene.air_cluster.numpy()
    faces = np.repeat(model.scene.quad_cluster.numpy(), 2)
    assert not listed.air_air[cluster[:, None] != cluster].any()
    assert not listed.air_face[cluster[:, None] != faces].any()


@pytest.mark.parametrize("device", DEVICES)
def test_two_searches_give_the_same_lists_in_the_same_order(device):
    model = small_model(device)
    scatter(model.scene, seed=45)
    first, again = bits(model), bits(model)
    other = small_model(device)
    scatter(other.scene, seed=45)
    elsewhere = bits(other)
    assert all(map(np.array_equal, first, again))
    assert all(map(np.array_equal, first, elsewhere))


@pytest.mark.parametrize("device", DEVICES)
def test_a_balloon_is_listed_alike_alone_and_in_a_batch(device):
    alone, batch = small_model(device), small_model(device, copies=2)
    for model in (alone, batch):
        scatter(model.scene, seed=46)
    assert all(map(np.array_equal, bits(alone), _of_first(batch)))


def _of_first(batch: KosakaModel) -> list[np.ndarray]:
    """The lists of the first of two balloons."""
    rows, (particles, faces) = bits(batch), (int(batch.scene.air_start[1]), 2 * len(small_plan()[1].quads))
    starts = np.cumsum([0, 2 * particles, 2 * particles])
    sizes = (particles, particles, faces)
    return [row for start, size in zip(starts, sizes, strict=True) for row in rows[start : start + size]]


@pytest.mark.parametrize("small", [members for _, members in LISTS])
@pytest.mark.parametrize("device", DEVICES)
def test_who_finds_no_room_is_counted(device, small):
    room = 5
    model = small_model(device)
    scatter(model.scene, seed=47)
    whole = search(model)
    most = max(matrix.sum(axis=1).max() for matrix in vars(whole).values())
    assert model.scene.most_near.numpy()[0] == most
    scene = model.scene
    scene.most_near.zero_()
    scene.arrays[small] = wp.zeros((len(scene.arrays[small]), room), dtype=int, device=device)
    cut = search(model)
    assert scene.most_near.numpy()[0] == most
    for name, matrix in vars(whole).items():
        assert not (vars(cut)[name] & ~matrix).any()
    short = dict(zip([members for _, members in LISTS], vars(cut).values(), strict=True))[small]
    assert short.sum(axis=1).max() == room
