"""A rigid figure under its weight: flight, landing, friction, rest."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.air import OUTSIDE_DENSITY
from balloon_usd.solver.falling import BOUNCE, DRAG, FallingFigure
from balloon_usd.solver.rigid_figure import ADDED_MASS, Lumps, RigidFigure

SIZE = np.array([0.3, 0.2, 0.1])
"""Edges of a box, m."""
MASS = 0.008
"""kg"""
GRAVITY = 9.81
CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * SIZE
FACES = np.array(
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]], dtype=np.int32
)


def box(*, height=0.0, displaced=0.0, faces=FACES, turn=None):
    """A box of mass in its corners whose lowest one is at a height, m; without faces there is no drag."""
    corners = CORNERS if turn is None else CORNERS @ turn.T
    corners = corners + [0.0, 0.0, height - corners[:, 2].min()]
    lumps = Lumps(corners, np.full(8, MASS / 8), np.full(8, displaced / 8))
    return RigidFigure.of(lumps, corners, faces, np.full(8, 500.0))


def smooth_box(**keys):
    return box(faces=FACES[:0], **keys)


def heights(figure, fall):
    return (figure.points @ fall.turn.T + fall.centre)[:, 2]


def test_a_figure_without_drag_falls_as_stones_do():
    fall = FallingFigure(smooth_box(height=2.0), GRAVITY, 0.5, ground=True)
    begin = fall.centre[2]
    fall.advance(0.5)
    assert begin - fall.centre[2] == pytest.approx(0.5 * GRAVITY * 0.5**2, rel=1e-9)
    assert fall.velocity[2] == pytest.approx(-GRAVITY * 0.5)
    assert fall.push == 0.0


def test_air_that_is_displaced_carries_and_has_to_be_moved():
    figure = box(displaced=0.004)
    displaced = OUTSIDE_DENSITY * 0.004
    assert figure.heavy == pytest.approx(MASS - displaced)
    assert figure.inertial == pytest.approx(MASS + ADDED_MASS * displaced)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_in_the_end_drag_on_the_face_ahead_carries_the_weight(axis):
    turn = np.roll(np.eye(3), axis, axis=0)
    figure = box(turn=turn)
    fall = FallingFigure(figure, GRAVITY, 0.5, ground=False)
    fall.advance(6.0)
    area = np.prod(SIZE) / SIZE[(2 - axis) % 3]
    speed = np.sqrt(2.0 * MASS * GRAVITY / (OUTSIDE_DENSITY * DRAG * area))
    assert -fall.velocity[2] == pytest.approx(speed, rel=1e-3)


def test_a_figure_that_spins_freely_keeps_its_energy_and_its_angular_momentum():
    figure = smooth_box()
    fall = FallingFigure(figure, 0.0, 0.5, ground=False)
    fall.spin = np.array([0.5, 6.0, 0.5])

    def kept():
        spin = fall.spin @ fall.turn
        momentum = figure.tensor @ spin
        return [0.5 * spin @ momentum, *(fall.turn @ momentum)]

    before = kept()
    for _ in range(400):
        fall.advance(0.005)
    assert not np.allclose(fall.turn[1], [0.0, 1.0, 0.0], atol=0.3)
    assert kept() == pytest.approx(before, rel=0.06, abs=0.06 * np.linalg.norm(before[1:]))


def test_it_bounces_with_the_share_of_its_speed_that_its_damping_leaves():
    figure = smooth_box(height=0.05)
    fall = FallingFigure(figure, GRAVITY, 0.5, ground=True)
    speeds = []
    for _ in range(400):
        fall.advance(0.0005)
        speeds.append(fall.velocity[2])
    # Four corners at once; contact ends where the force does (Schwager & Poeschel 2007, eq. 21).
    damping = 2.0 * BOUNCE
    rate = np.sqrt(1.0 - damping**2)
    until = np.pi - np.arctan2(2.0 * damping * rate, rate**2 - damping**2)
    assert max(speeds) / -min(speeds) == pytest.approx(np.exp(-damping / rate * until), rel=0.1)


@pytest.mark.parametrize("friction", [0.2, 0.8])
def test_a_figure_that_slides_is_braked_by_friction_alone(friction):
    figure = smooth_box()
    fall = FallingFigure(figure, GRAVITY, friction, np.array([0.6, 0.3, 0.0]), ground=True)
    begin = fall.centre[:2].copy()
    fall.advance(1.5)
    way = np.linalg.norm(fall.centre[:2] - begin)
    speed = np.hypot(0.6, 0.3)
    assert way == pytest.approx(speed**2 / (2.0 * friction * GRAVITY), rel=0.05)
    assert np.linalg.norm(fall.velocity) < 1e-4
    assert fall.push == pytest.approx(fall.weight, rel=1e-3)


def test_what_rests_on_the_ground_does_not_creep():
    figure = smooth_box()
    fall = FallingFigure(figure, GRAVITY, 0.3, ground=True)
    fall.settle()
    assert fall.sleeps
    before = fall.centre.copy()
    for _ in range(100):
        fall.sleeps = False
        fall.advance(0.1)
    assert fall.centre == pytest.approx(before, abs=1e-6)
    assert heights(figure, fall).min() > -1e-4
    assert fall.push == pytest.approx(fall.weight)


def test_a_box_on_its_edge_falls_on_the_nearest_side():
    angle = np.radians(50.0)
    turn = np.array(
        [[np.cos(angle), 0.0, np.sin(angle)], [0.0, 1.0, 0.0], [-np.sin(angle), 0.0, np.cos(angle)]]
    )
    figure = smooth_box(turn=turn)
    fall = FallingFigure(figure, GRAVITY, 0.8, ground=True)
    fall.advance(3.0)
    assert np.ptp(np.sort(heights(figure, fall))[:4]) < 1e-4
    assert np.ptp(heights(figure, fall)) == pytest.approx(SIZE[2], abs=1e-3)


def test_without_ground_it_falls_on():
    fall = FallingFigure(smooth_box(), GRAVITY, 0.5, ground=False)
    fall.advance(1.0)
    assert fall.centre[2] < -4.0


def test_what_has_moved_is_told_as_a_turn_and_a_shift():
    figure = smooth_box(height=0.5)
    fall = FallingFigure(figure, GRAVITY, 0.5, np.array([1.0, 0.0, 2.0]), ground=True)
    fall.spin = np.array([0.0, 3.0, 1.0])
    fall.advance(0.3)
    start = np.roll(np.eye(3), 1, axis=0), np.array([0.1, 0.2, 0.3])
    corner = figure.points[3] + figure.centre
    made = (corner - start[1]) @ start[0]
    turn, shift = fall.moved(*start)
    assert turn @ made + shift == pytest.approx(fall.turn @ figure.points[3] + fall.centre)


def test_what_lies_on_many_vertices_is_steady():
    # A long light rod, flat on the ground: each of its vertices alone could carry it.
    along = np.linspace(-0.5, 0.5, 200)
    corners = np.column_stack([np.repeat(along, 2), np.tile([-0.01, 0.01], 200), np.zeros(400)])
    lumps = Lumps(corners, np.full(400, 1e-3 / 400), np.zeros(400))
    figure = RigidFigure.of(lumps, corners, FACES[:0], np.full(400, 800.0))
    fall = FallingFigure(figure, GRAVITY, 0.8, np.array([0.5, 0.0, 0.0]), ground=True)
    for _ in range(50):
        fall.advance(0.02)
        assert np.linalg.norm(fall.velocity) < 0.6
    assert fall.sleeps
    assert fall.push == pytest.approx(fall.weight, rel=1e-3)


def test_hands_let_a_figure_tip_that_hardly_begins_to_until_it_lies():
    # On an edge, its centre a hair beyond it.
    angle = np.arctan2(SIZE[0], SIZE[2]) - np.radians(0.02)
    turn = np.array(
        [[np.cos(angle), 0.0, np.sin(angle)], [0.0, 1.0, 0.0], [-np.sin(angle), 0.0, np.cos(angle)]]
    )
    figure = box(turn=turn)
    fall = FallingFigure(figure, GRAVITY, 0.5, ground=True)
    fall.settle()
    assert fall.sleeps
    assert fall.centre[2] == pytest.approx(0.5 * SIZE[2], abs=1e-3)
