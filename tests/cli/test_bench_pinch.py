"""What `bench --peer` measures: crossings, necks and wound turns of tubes whose shape is known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.bench.pierced import pierced_triangles
from balloon_usd.bench.pinch_shape import neck_height, volume, wound_turns
from balloon_usd.bench.pinch_task import AROUND, LENGTH, PINCHED, RADIUS, TURN, PinchTask
from balloon_usd.bench.pinch_wall import SPRING, HeldVertices, springs

TASK = PinchTask(1602)
START = TASK.mesh.points.astype(np.float64)
TETRAHEDRON = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
CORNERS = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])


def twisted(points, turn):
    """Points turned about x, in proportion to how far along they are."""
    angle = turn * points[:, 0] / LENGTH
    y, z = points[:, 1], points[:, 2]
    return np.column_stack(
        [points[:, 0], np.cos(angle) * y - np.sin(angle) * z, np.sin(angle) * y + np.cos(angle) * z]
    )


def drawn_in(points, slope):
    """Points of the tube with a neck of two cones of this slope, down to the pinch."""
    share = np.minimum(1.0, PINCHED + slope * np.abs(points[:, 0] - 0.5 * LENGTH))
    return points * np.column_stack([np.ones_like(share), share, share])


@pytest.mark.parametrize("vertices", AROUND)
def test_the_tube_has_the_vertices_that_are_asked_for(vertices):
    assert len(PinchTask(vertices).mesh.points) == vertices


def test_a_tube_that_nothing_touches_pierces_nothing():
    assert pierced_triangles(START, TASK.triangles) == 0


def test_a_corner_in_another_solid_pierces_one_face_with_three_edges():
    other = CORNERS * 0.5 + np.array([0.2, 0.2, -0.4])
    both = np.concatenate([CORNERS, other])
    assert pierced_triangles(both, np.concatenate([TETRAHEDRON, TETRAHEDRON + 4])) == 3


def test_solids_apart_pierce_nothing():
    both = np.concatenate([CORNERS, CORNERS + 2.0])
    assert pierced_triangles(both, np.concatenate([TETRAHEDRON, TETRAHEDRON + 4])) == 0


def test_the_volume_is_that_of_a_capsule():
    theory = math.pi * RADIUS**2 * (LENGTH - 2.0 * RADIUS / 3.0)
    assert volume(START, TASK.triangles) == pytest.approx(theory, rel=1e-2)


def test_the_neck_of_two_cones_is_as_high_as_their_slope_says():
    slope = 40.0
    assert neck_height(TASK, START, drawn_in(START, slope)) == pytest.approx(
        (0.8 - PINCHED) / slope, abs=1e-4
    )


def test_a_tube_without_a_neck_has_none():
    assert neck_height(TASK, START, START) == 0.0


def test_a_tube_that_is_thin_all_along_has_a_neck_without_an_end():
    assert math.isnan(neck_height(TASK, START, START * np.array([1.0, 0.5, 0.5])))


@pytest.mark.parametrize("turns", [0.0, 0.5, 1.0, 3.0])
def test_turns_are_counted_beyond_a_whole_one(turns):
    inner = TASK.mesh.ring_along[-1] - TASK.mesh.ring_along[0]
    found = wound_turns(TASK, twisted(START, 2.0 * math.pi * turns))
    assert found == pytest.approx(turns * inner / LENGTH, abs=1e-4)


def test_hands_pinch_first_and_turn_then():
    assert [TASK.pinch_at(frame) for frame in (29, 45, 59)] == [pytest.approx(PINCHED)] * 3
    assert TASK.turn_at(29) == 0.0
    assert TASK.turn_at(59) == pytest.approx(TURN)


def test_what_hands_hold_of_a_net_of_springs_starts_where_the_tube_is_and_ends_turned():
    held = HeldVertices(TASK)
    assert np.allclose(held.places(0), START[held.index], atol=1e-9)
    first, last = TASK.ends
    end = dict(zip(held.index, held.places(TASK.frames), strict=True))
    # Half a turn each way.
    for i in (first[0], last[0]):
        assert np.allclose(end[i], START[i] * [1, -1, -1], atol=1e-9)
    ring = TASK.ring(TASK.middle)
    assert np.linalg.norm(end[ring[0]][1:]) == pytest.approx(PINCHED * RADIUS, rel=1e-4)


def test_fingers_pinch_rings_on_both_sides_of_the_middle_and_one_ring_is_the_middle():
    rings = TASK.pinched
    assert rings[len(rings) // 2] == TASK.middle
    assert len(rings) == 7
    assert PinchTask(6402).pinched[-1] - PinchTask(6402).pinched[0] == 2 * (rings[-1] - rings[0])
    assert PinchTask(1602, width=0.0).pinched == (TASK.middle,)


def test_springs_run_along_all_sides_and_diagonals_of_faces():
    faces = len(TASK.mesh.quads)
    assert len(springs(TASK.mesh.quads)) == 2 * faces + 2 * faces
    assert SPRING > 0.0
