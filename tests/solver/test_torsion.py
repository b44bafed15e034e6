"""Wound joints and hinges: springing back, and turning freely in the air."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.latex.hinge import HingedParts, Part, rotation, rotation_vector, screw
from balloon_usd.solver.latex.torsion import OPEN_ANGLE, WoundJoint

CHAIN = "format: 1\nname: c\nunits: cm\nballoons: {main: {size: 260, length: 14, tail: 5}}\nsteps: [bubbles: {a: 8}]\n"


def wound(turns):
    joint = WoundJoint(plan(Recipe.parse(CHAIN)).strips["main"], "a", 2.475e-3, 0.0255)
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


@pytest.mark.parametrize("turns", [3.0, -3.0])
def test_a_wound_joint_without_drag_springs_open_in_a_quarter_of_its_period(turns):
    joint, inertia, step = wound(turns), 4e-5, 1e-4
    torque, seconds = joint.torque, 0.0
    assert math.copysign(1.0, torque) == math.copysign(1.0, turns)
    period = 2.0 * math.pi * math.sqrt(inertia / joint.stiffness)
    while joint.turns:
        angle = joint.spring_back(inertia, 0.0, math.inf, step)
        assert angle * turns < 0.0
        seconds += step
    missed = OPEN_ANGLE / (2.0 * math.pi * abs(turns)) / (2.0 * math.pi) * period
    assert seconds + missed == pytest.approx(0.25 * period, abs=2.0 * step)


def test_a_wound_neck_springs_back_with_some_thousandths_of_a_newton_metre():
    assert 1e-3 < wound(3.0).torque < 20e-3


def test_a_waist_closes_at_half_a_turn_as_a_cage_of_strings_does():
    for degrees, waist in ((60.0, 0.866), (90.0, 0.7071), (120.0, 0.5), (180.0, 0.0), (720.0, 0.0)):
        assert wound(degrees / 360.0).waist == pytest.approx(waist * 0.0255, abs=1e-5)
