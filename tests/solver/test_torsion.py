"""Wound joints and hinges: springing back, and turning freely in the air."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.balloon.wound_neck import drawn_in_a_turn
from balloon_usd.plan import plan
from balloon_usd.plan.open_tube import softened
from balloon_usd.recipe import Recipe
from balloon_usd.solver.latex.hinge import HingedParts, Part, screw
from balloon_usd.solver.latex.torsion import OPEN_ANGLE, WoundJoint
from balloon_usd.solver.rotations import rotation, rotation_vector

CHAIN = "format: 1\nname: c\nunits: cm\nballoons: {main: {size: 260, length: 14, tail: 5}}\nsteps: [bubbles: {a: 8}]\n"


def wound(turns, planned=0.0):
    joint = WoundJoint(plan(Recipe.parse(CHAIN)).strips["main"], "a", 2.475e-3, 0.0255, planned)
    joint.turns = turns
    return joint


def blob(seed, shift):
    """Vertices (V, 3), m, of some masses (V,), kg."""
    random = np.random.default_rng(seed)
    return random.normal(scale=0.02, size=(40, 3)) + shift, random.uniform(1e-3, 2e-3, size=40)


@pytest.fixture
def pair():
    """Vertices and masses of two parts that meet in the origin, and the parts."""
    sides = [blob(1, [-0.05, 0.01, 0.0]), blob(2, [0.08, 0.0, 0.03])]
    parts = [Part.of(arm, mass, arm.mean(axis=0)) for arm, mass in sides]
    return sides, HingedParts(np.zeros(3), *parts)


def test_both_sides_of_a_hinge_spring_apart_without_momentum_or_angular_momentum(pair):
    sides, parts = pair
    _, motion = parts.response()
    push, turn, scale = np.zeros(3), np.zeros(3), 0.0
    for (arm, mass), spin in zip(sides, (motion[3:6], motion[6:]), strict=True):
        speed = motion[:3] + np.cross(spin, arm)
        push += (mass[:, None] * speed).sum(axis=0)
        turn += (mass[:, None] * np.cross(arm, speed)).sum(axis=0)
        scale += (mass * np.linalg.norm(speed, axis=1)).sum()
    assert np.abs(push).max() < 1e-12 * scale
    assert np.abs(turn).max() < 1e-12 * scale


def test_the_inertia_of_a_hinge_is_that_of_the_energy_of_its_motion(pair):
    sides, parts = pair
    inertia, motion = parts.response()
    energy = 0.0
    for (arm, mass), spin in zip(sides, (motion[3:6], motion[6:]), strict=True):
        energy += 0.5 * (mass * ((motion[:3] + np.cross(spin, arm)) ** 2).sum(axis=1)).sum()
    assert 2.0 * energy == pytest.approx(inertia, rel=1e-9)


def test_two_coaxial_bubbles_spin_about_their_axis_as_their_inertias_ask():
    arm, mass = blob(3, [0.05, 0.0, 0.0])
    arm = np.concatenate([arm, arm * [1.0, -1.0, -1.0]])
    mass = np.concatenate([mass, mass])
    parts = HingedParts(
        np.zeros(3),
        Part.of(-arm, 3.0 * mass, np.array([-0.05, 0.0, 0.0])),
        Part.of(arm, mass, np.array([0.05, 0.0, 0.0])),
    )
    _, motion = parts.response()
    assert motion[6] == pytest.approx(0.75, rel=0.2)
    assert motion[3] == pytest.approx(motion[6] - 1.0, rel=1e-9)


def test_a_screw_kept_for_a_frame_ends_where_the_body_went():
    turned, moved = rotation(np.array([0.9, -1.1, 0.4])), np.array([0.01, -0.03, 0.02])
    rate, axis, drift = screw(turned, moved, 0.5)
    steps = 2000
    here = start = np.array([0.1, 0.2, -0.05])
    by = rotation(np.array(axis, dtype=float) * rate * 0.5 / steps)
    for _ in range(steps):
        here = by @ here + np.array(drift, dtype=float) * 0.5 / steps
    assert here == pytest.approx(turned @ start + moved, abs=3e-5)


def test_a_body_that_does_not_turn_only_drifts():
    rate, _, drift = screw(np.eye(3), np.array([0.02, 0.0, -0.01]), 0.5)
    assert rate == 0.0
    assert np.array(drift) == pytest.approx([0.04, 0.0, -0.02])


@pytest.mark.parametrize("vector", [(0.0, 0.0, 0.0), (1e-4, 0.0, 0.0), (0.3, -2.0, 0.5)])
def test_the_vector_of_a_rotation_is_found_again(vector):
    assert rotation_vector(rotation(np.array(vector))) == pytest.approx(np.array(vector), abs=1e-9)


def sprung_open(turns, inertia, step):
    """Seconds in which a joint without drag springs open, down to where it is as good as open."""
    joint, seconds = wound(turns), 0.0
    assert math.copysign(1.0, joint.torque) == math.copysign(1.0, turns)
    while joint.turns:
        assert joint.spring_back(inertia, 0.0, math.inf, step) * turns < 0.0
        seconds += step
    return seconds


@pytest.mark.parametrize("turns", [0.5, -0.5])
def test_a_joint_of_half_a_turn_without_drag_springs_open_in_a_quarter_of_its_period(turns):
    inertia, step = 4e-5, 1e-4
    rate = math.sqrt(wound(turns).stiffness / inertia)
    left = math.acos(OPEN_ANGLE / (2.0 * math.pi * abs(turns)))
    assert sprung_open(turns, inertia, step) == pytest.approx(left / rate, abs=2.0 * step)


@pytest.mark.parametrize("turns", [3.0, -8.0])
def test_a_joint_of_many_turns_springs_open_with_an_even_torque_at_first(turns):
    inertia, step = 4e-5, 1e-4
    joint = wound(turns)
    elastic = joint.most_torque / joint.stiffness
    even = math.sqrt(2.0 * (joint.angle - elastic) * inertia / joint.most_torque)
    rate, speed = math.sqrt(joint.stiffness / inertia), joint.most_torque / inertia * even
    amplitude = math.hypot(elastic, speed / rate)
    swing = math.acos(OPEN_ANGLE / amplitude) - math.acos(elastic / amplitude)
    assert sprung_open(turns, inertia, step) == pytest.approx(even + swing / rate, abs=3.0 * step)


def test_a_wound_neck_springs_back_with_two_thousandths_of_a_newton_metre_whatever_its_turns():
    assert wound(3.0).torque == pytest.approx(2.37e-3, rel=0.01)
    assert wound(-8.0).torque == -wound(3.0).torque


def test_as_much_rubber_is_drawn_in_as_turns_beyond_those_that_pack_the_neck_are_wound():
    planned = wound(8.0).strip, wound(8.0)
    assert planned[1].drawn == 0.0
    five = 5.0 * drawn_in_a_turn(planned[0].size, softened(planned[0].rubber))
    for turns, share in ((2.0, 0.0), (3.0, 0.0), (5.5, 0.5), (-8.0, 1.0)):
        assert wound(turns, five).drawn == pytest.approx(share)


def test_a_waist_closes_at_half_a_turn_as_a_cage_of_strings_does():
    for degrees, waist in ((60.0, 0.866), (90.0, 0.7071), (120.0, 0.5), (180.0, 0.0), (720.0, 0.0)):
        assert wound(degrees / 360.0).waist == pytest.approx(waist * 0.0255, abs=1e-5)
