"""A rubber vertex inside a wall is put onto it as the thesis says (eqs. 3.14, 3.15)."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.kernels.kosaka.offset_regions import WIDER
from balloon_usd.solver.kernels.kosaka.wall_contact import part_walls
from tests.solver import kosaka_reference as thesis
from tests.solver.kosaka_bench import DEVICES, launch, laws, off, single

THICKNESS = 0.002
UNCLEAR = 1e-7
"""How near to a border float32 does not know the side, m."""


def part(device: str, x, quads, normal, target, v=None, neck=()):
    joint = np.full(len(x), -1, dtype=np.int32)
    joint[list(neck)] = 0
    return launch(
        part_walls,
        device,
        len(x),
        quads=np.asarray(quads, dtype=np.int32),
        vertex_joint=joint,
        vertex_balloon=np.zeros(len(x), dtype=np.int32),
        radius_to=np.full(1, 0.005),
        constants=laws(contact_offset=THICKNESS),
        target=np.asarray(target, dtype=np.int32),
        normal=np.asarray(normal, dtype=float),
        x=x,
        v=np.zeros((len(x), 3)) if v is None else v,
        x_next=np.zeros((len(x), 3)),
    )


def above(device: str, place, facing):
    """Where a vertex ends up beside a square wall that spans 0 to 1 cm in x and y and faces +z."""
    wall = [[0.0, 0.0, 0.0], [0.01, 0.0, 0.0], [0.01, 0.01, 0.0], [0.0, 0.01, 0.0]]
    x = np.array([*wall, place], dtype=float)
    normal = np.array([(0.0, 0.0, 1.0)] * 4 + [facing])
    target = [(-1, -1)] * 4 + [(0, -1)]
    after = part(device, x, [(0, 1, 2, 3)], normal, target)["x_next"]
    assert np.array_equal(after[:4], x[:4].astype(np.float32))
    return after[4]


def many(seed: int):
    """Bent square walls far from each other, each with vertices about it at random: x, quads, normal, target."""
    random = np.random.default_rng(seed)
    walls, each = 60, 8
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]) * 0.01
    place = np.column_stack([np.arange(walls) % 8 - 4, np.arange(walls) // 8 - 4, np.zeros(walls)]) * 0.03
    wall = place[:, None] + corners + random.normal(0.0, 7e-4, (walls, 4, 3))
    loose = place[:, None] + random.uniform((-0.002, -0.002, -0.004), (0.012, 0.012, 0.002), (walls, each, 3))
    x = single(np.concatenate([wall.reshape(-1, 3), loose.reshape(-1, 3)]))
    quads = np.arange(4 * walls).reshape(-1, 4)
    normal = random.normal(0.0, 1.0, x.shape)
    normal = single(normal / thesis.length(normal)[:, None])
    target = np.full((len(x), 2), -1)
    target[4 * walls :, 0] = np.repeat(np.arange(walls), each)
    return x, quads, normal, target


def parted(x, quads, normal, target, v):
    """Where the thesis puts every vertex, one triangle of its wall after the other, what is left of its speed,
    and how far it is from being judged otherwise (m).
    """
    triangles = thesis.triangles_of(quads)
    p, u, clear = x.copy(), v.copy(), np.full(len(x), np.inf)
    loose = np.flatnonzero(target[:, 0] >= 0)
    for half in range(2):
        a, b, c = np.moveaxis(x[triangles[2 * target[loose, 0] + half]], 1, 0)
        n = thesis.plane_normal(a, b, c)
        d = thesis.plane_distance(p[loose], a, n)
        over = thesis.shares(thesis.projection(p[loose], a, n), a, b, c).min(axis=1) + WIDER
        against = thesis.dot(normal[loose], n)
        inside = (d < 0.0) & (d > -THICKNESS) & (over > 0.0) & (against < 0.0)
        border = np.min(np.abs([d, d + THICKNESS, 0.01 * over, against]), axis=0)
        clear[loose] = np.minimum(clear[loose], border)
        p[loose] = thesis.wall_checked(p[loose], a, n, inside)
        u[loose] = thesis.stopped(u[loose], n, inside)
    return p, u, clear


@pytest.mark.parametrize("device", DEVICES)
def test_walls_part_as_in_the_thesis(device):
    x, quads, normal, target = many(seed=34)
    wanted, _, clear = parted(x, quads, normal, target, np.zeros_like(x))
    known = clear > UNCLEAR
    moved = known & (wanted != x).any(axis=1)
    assert moved.sum() > 50
    after = part(device, x, quads, normal, target)["x_next"]
    assert off((after - x)[moved], (wanted - x)[moved]) < 1e-5
    assert np.array_equal(after[known & ~moved], x[known & ~moved].astype(np.float32))


@pytest.mark.parametrize("device", DEVICES)
def test_a_vertex_put_onto_a_wall_does_not_go_on_into_it(device):
    x, quads, normal, target = many(seed=37)
    v = single(np.random.default_rng(38).normal(0.0, 0.3, x.shape))
    _, wanted, clear = parted(x, quads, normal, target, v)
    known = clear > UNCLEAR
    slower = known & (wanted != v).any(axis=1)
    assert slower.sum() > 25
    after = part(device, x, quads, normal, target, v)["v"]
    assert off((after - v)[slower], (wanted - v)[slower]) < 1e-5
    assert np.array_equal(after[known & ~slower], v[known & ~slower].astype(np.float32))


@pytest.mark.parametrize("device", DEVICES)
def test_a_vertex_inside_a_wall_is_put_onto_it(device):
    assert above(device, (0.004, 0.003, -0.001), (0, 0, -1)) == pytest.approx([0.004, 0.003, 0.0])


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize(
    ("place", "facing"),
    [
        pytest.param((0.004, 0.003, 0.001), (0, 0, -1), id="outside"),
        pytest.param((0.004, 0.003, -1.1 * THICKNESS), (0, 0, -1), id="too deep"),
        pytest.param((0.012 + 0.01 * WIDER, 0.003, -0.001), (0, 0, -1), id="beside the wall"),
        pytest.param((0.004, 0.003, -0.001), (0, 0, 1), id="of the same wall"),
    ],
)
def test_any_other_vertex_stays_where_it_is(device, place, facing):
    assert np.array_equal(above(device, place, facing), np.array(place, dtype=np.float32))


@pytest.mark.parametrize("device", DEVICES)
def test_necks_stay_where_hands_closed_them(device):
    x, quads, normal, target = many(seed=39)
    neck = np.arange(len(x) - 100, len(x))
    v = np.full_like(x, 0.1)
    free, held = (part(device, x, quads, normal, target, v, necks) for necks in ((), neck))
    assert not np.array_equal(free["x_next"][neck], x[neck].astype(np.float32))
    assert np.array_equal(held["x_next"][neck], x[neck].astype(np.float32))
    assert np.array_equal(held["v"][neck], v[neck].astype(np.float32))
    assert np.array_equal(held["x_next"][: neck[0]], free["x_next"][: neck[0]])
