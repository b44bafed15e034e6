"""The mesh of a balloon is one closed surface of quads with a ring wherever it was asked for."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.detail import DETAILS, detail_named
from balloon_usd.balloon.sizes import SIZES, size_named
from balloon_usd.balloon.tube_mesh import TORN_ROWS, first_torn_row, ring_stations, tube_mesh
from tests.balloon.volume import volume_of

JOINTS = (0.0287, 0.0574, 0.09)


def dog_tube(detail="draft", size="260"):
    return tube_mesh(size_named(size), detail_named(detail), JOINTS, (*JOINTS, size_named(size).length))


def round_balloon(detail="draft", size="R5"):
    return tube_mesh(size_named(size), detail_named(detail), (), (size_named(size).length,))


@pytest.mark.parametrize("size", [size.name for size in SIZES])
@pytest.mark.parametrize("detail", list(DETAILS))
def test_every_edge_of_every_size_is_shared_by_two_quads_in_opposite_directions(size, detail):
    made = dog_tube if size_named(size).neck is None else round_balloon
    quads = made(detail, size).quads
    edges = np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)])
    there, back = {tuple(e) for e in edges}, {tuple(e[::-1]) for e in edges}
    assert len(there) == len(edges)
    assert there == back


def test_every_vertex_is_used_and_the_surface_is_a_sphere():
    mesh = dog_tube()
    assert set(mesh.quads.ravel()) == set(range(len(mesh.points)))
    assert len(mesh.points) == len(mesh.quads) + 2


def test_the_surface_faces_outwards_and_holds_the_tubes_volume():
    mesh, size = dog_tube("full"), size_named("260")
    volume = volume_of(mesh.points, mesh.quads)
    assert volume == pytest.approx(np.pi * size.radius**2 * size.length, rel=0.08)


@pytest.mark.parametrize("size", ["R5", "R11"])
def test_a_round_balloon_is_as_wide_at_its_neck_and_at_its_widest_ring_as_its_size_says(size):
    mesh, of = round_balloon("full", size), size_named(size)
    apothem = np.linalg.norm(mesh.points[:, 1:], axis=1) * np.cos(np.pi / mesh.around)
    rings = apothem[mesh.ring_start[:, None] + np.arange(mesh.around)]
    assert rings[mesh.ring_at(0.0)] == pytest.approx(of.neck, rel=1e-5)
    assert rings.max() == pytest.approx(of.radius, rel=0.01)
    assert rings[-1].mean() < 0.9 * of.radius


def test_the_wall_of_a_round_balloon_has_the_area_that_its_weight_is_reckoned_from():
    mesh, of = round_balloon("full", "R11"), size_named("R11")
    corners = mesh.points[mesh.quads[(mesh.along[mesh.quads] >= -1e-6).all(axis=1)]].astype(float)
    areas = 0.5 * np.linalg.norm(
        np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), axis=1
    )
    assert areas.sum() == pytest.approx(of.rubber_volume / of.thickness, rel=0.02)


def test_the_lobes_of_a_heart_lie_to_both_sides_and_its_cap_in_the_cleft():
    mesh, of = round_balloon("full", "H6"), size_named("H6")
    body = mesh.points[mesh.along > 0.0]
    assert np.ptp(body[:, 1]) == pytest.approx(2.0 * of.radius, rel=0.03)
    left, right = body[body[:, 1] > 0.0, 0].max(), body[body[:, 1] < 0.0, 0].max()
    assert left == pytest.approx(right, rel=1e-5)
    cap = mesh.points[mesh.along > mesh.ring_along[-1], 0]
    assert np.sort(cap)[len(cap) // 2] < 0.9 * left


def test_the_polygon_is_drawn_about_the_circle_of_the_tube():
    mesh, size = dog_tube(), size_named("260")
    ring = mesh.points[mesh.ring_start[mesh.ring_at(0.05)] :][: mesh.around, 1:]
    sides = 0.5 * (ring + np.roll(ring, -1, axis=0))
    assert np.linalg.norm(sides, axis=1) == pytest.approx(size.radius, rel=1e-5)


def test_a_ring_stands_at_every_joint_and_spacing_is_finest_beside_it():
    mesh = dog_tube()
    for joint in JOINTS:
        ring = mesh.ring_at(joint)
        assert mesh.ring_along[ring] == pytest.approx(joint, abs=1e-9)
        spacing = np.diff(mesh.ring_along)
        assert spacing[ring] < 0.8 * spacing[ring : ring + 5].max()


def test_bubbles_take_the_faces_between_their_joints():
    mesh = dog_tube()
    middle = mesh.along[mesh.quads].mean(axis=1)
    for bubble, (low, high) in enumerate(zip((-1.0, *JOINTS), (*JOINTS, 1.0), strict=True)):
        inside = middle[mesh.quad_bubble == bubble]
        assert inside.min() > low
        assert inside.max() < high


@pytest.mark.parametrize("mesh", [dog_tube(), dog_tube().mirrored()], ids=["as made", "mirrored"])
def test_texture_runs_once_round_the_tube_and_once_along_it_and_no_face_lies_on_another(mesh):
    st = mesh.st.astype(np.float64)
    assert st.shape == (len(mesh.quads), 4, 2)
    sides = st.max(axis=1) - st.min(axis=1)
    cap = (mesh.around // 4) ** 2
    tiles = np.floor(st[..., 0].min(axis=1))
    assert np.array_equal(tiles, np.repeat([1.0, 0.0, 2.0], [cap, len(st) - 2 * cap, cap]))
    for tile in range(3):
        assert np.prod(sides[tiles == tile], axis=1).sum() == pytest.approx(1.0, rel=1e-5)
        assert st[tiles == tile, :, 0].max() == pytest.approx(tile + 1.0)
    middles = np.round(st.mean(axis=1), 6)
    assert len(np.unique(middles, axis=0)) == len(st)
    one, other = st[:, 1] - st[:, 0], st[:, 3] - st[:, 0]
    assert len(np.unique(np.sign(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]))) == 1


def test_a_joint_beyond_the_tube_is_refused():
    with pytest.raises(ValueError, match="joints must lie between"):
        ring_stations(detail_named("draft"), size_named("260"), (0.5,))


@pytest.mark.parametrize("length", [0.008, 0.014, 0.021])
@pytest.mark.parametrize("detail", ["draft", "preview", "full"])
def test_every_guide_of_a_short_bubble_has_a_ring_of_its_own(detail, length):
    guides = tuple(0.03 + length * k / 8 for k in range(1, 8))
    stations = ring_stations(detail_named(detail), size_named("260"), (0.03, 0.03 + length), guides)
    led = [int(np.argmin(np.abs(stations - guide))) for guide in guides]
    ends = [int(np.argmin(np.abs(stations - end))) for end in (0.03, 0.03 + length)]
    assert len({*led, *ends}) == len(led) + len(ends)
    assert np.all(np.diff(stations) > 0.0)


def test_a_guide_beside_the_last_ring_is_led_by_it():
    size = size_named("260")
    last = size.length - size.radius
    few = ring_stations(detail_named("draft"), size, (0.1,))
    assert len(ring_stations(detail_named("draft"), size, (0.1,), (last - 1e-6,))) == len(few)


def test_a_bubble_that_tears_has_five_rows_where_two_stood_and_all_other_rings_stay():
    size, detail = size_named("260"), detail_named("draft")
    plain = ring_stations(detail, size, (0.05, 0.1, 0.15))
    torn = ring_stations(detail, size, (0.05, 0.1, 0.15), torn=(0.075,))
    assert len(torn) == len(plain) + 3
    inside = (torn > 0.05) & (torn < 0.1)
    assert set(torn[~inside]) == set(plain[(plain <= 0.05) | (plain >= 0.1)])
    rows = np.diff(torn[(torn >= 0.05) & (torn <= 0.1)])
    first = first_torn_row(len(rows))
    assert np.ptp(rows[first : first + TORN_ROWS]) == pytest.approx(0.0, abs=1e-12)
    assert rows.sum() == pytest.approx(0.05)
    # As many rows on either side, or one more.
    assert len(rows) - TORN_ROWS - 2 * first in (0, 1)


@pytest.mark.parametrize("length", [0.004, 0.02, 0.2])
def test_the_shortest_bubble_can_tear_too(length):
    size, detail = size_named("260"), detail_named("draft")
    torn = ring_stations(detail, size, (0.05, 0.05 + length), torn=(0.05 + 0.5 * length,))
    rows = np.diff(torn[(torn >= 0.05) & (torn <= 0.05 + length)])
    assert len(rows) >= TORN_ROWS
    assert rows.min() > 0.0
