"""Wound joints and hinges: springing back, and turning freely in the air."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.balloon.wound_neck import drawn_in_a_turn
from balloon_usd.plan import plan
from balloon_usd.plan.open_tube import softened
from balloon_usd.recipe import Recipe
from balloon_usd.solver.latex.hinges import Hinge, HingedParts, Limits, Part, screw
from balloon_usd.solver.latex.unwinding import impulses_after
from balloon_usd.solver.latex.wound_joint import OPEN_ANGLE, WoundJoint
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
def chain():
    """Vertices and masses of three parts that hang together in two joints, and the parts, turned by now."""
    sides = [blob(1, [-0.05, 0.01, 0.0]), blob(2, [0.08, 0.0, 0.03]), blob(3, [0.2, 0.05, 0.0])]
    parts = [Part.of(places, mass) for places, mass in sides]
    joints = np.zeros(3), np.array([0.14, 0.02, 0.01])
    hinges = [Hinge(0, 1, joints[0], parts[0].centre, parts[1].centre)]
    hinges.append(Hinge(2, 1, joints[1], parts[2].centre, parts[1].centre))
    hinged = HingedParts(parts, hinges)
    hinged.turn(np.array([[0.4, 0.1, -0.3], [-1.0, 0.5, 0.2], [0.3, 2.0, -0.4]]), 0.5)
    return sides, hinged


def moved(sides, hinged, response, hinge):
    """Places and velocities of all vertices for an impulse in one hinge, each (V, 3), and their masses."""
    places, speeds = [], []
    centres = hinged.centres()
    for k, part in enumerate(hinged.parts):
        arms = (sides[k][0] - part.centre) @ part.turned.T
        places.append(centres[k] + arms)
        speeds.append(response.shifts[k, :, hinge] + np.cross(response.turns[k, :, hinge], arms))
    return np.concatenate(places), np.concatenate(speeds), np.concatenate([mass for _, mass in sides])


def test_parts_stay_together_in_their_joints_and_their_middle_where_it_was(chain):
    sides, hinged = chain
    centres = hinged.centres()
    for hinge in hinged.hinges:
        ends = [centres[k] + hinged.parts[k].arm(hinge.joint) for k in (hinge.before, hinge.beyond)]
        assert ends[0] == pytest.approx(ends[1], abs=1e-12)
    places, _, mass = moved(sides, hinged, hinged.response(), 0)
    before = np.concatenate([points for points, _ in sides])
    assert mass @ places == pytest.approx(mass @ before, abs=1e-12)


@pytest.mark.parametrize("hinge", [0, 1])
def test_parts_spring_apart_without_momentum_or_angular_momentum(chain, hinge):
    places, speeds, mass = moved(*chain, chain[1].response(), hinge)
    scale = (mass * np.linalg.norm(speeds, axis=1)).sum()
    assert np.abs(mass @ speeds).max() < 1e-12 * scale
    assert np.abs(mass @ np.cross(places, speeds)).max() < 1e-12 * scale


def test_the_compliance_of_a_hinge_is_that_of_the_energy_of_its_motion(chain):
    response = chain[1].response()
    for hinge in (0, 1):
        _, speeds, mass = moved(*chain, response, hinge)
        energy = 0.5 * (mass * (speeds**2).sum(axis=1)).sum()
        assert 2.0 * energy == pytest.approx(response.compliance[hinge, hinge], rel=1e-9)
    assert response.compliance[0, 1] == pytest.approx(response.compliance[1, 0], rel=1e-9)


def test_the_velocities_of_parts_are_those_at_which_their_centres_go(chain):
    _, hinged = chain
    response, step = hinged.response(), 1e-9
    before = hinged.centres()
    hinged.turn(response.turns[:, :, 1], step)
    assert (hinged.centres() - before) / step == pytest.approx(response.shifts[:, :, 1], rel=1e-3, abs=1e-3)


def test_walls_move_no_faster_than_they_may(chain):
    sides, hinged = chain
    response = hinged.response()
    found = hinged.fastest_walls(response)
    for hinge in (0, 1):
        _, speeds, _ = moved(sides, hinged, response, hinge)
        fastest = np.linalg.norm(speeds, axis=1).max()
        assert 0.9 * fastest < found[hinge] < (1.0 + 1e-9) * fastest
        turn, centre = (
            np.linalg.norm(each[:, :, hinge], axis=1).max() for each in (response.turns, response.shifts)
        )
        impulses, none = np.eye(2)[hinge], Limits(math.inf, math.inf, math.inf)
        for limits, share in (
            (none._replace(wall=0.25 * found[hinge]), 0.25),
            (none._replace(centre=0.1 * centre), 0.1),
            (none._replace(turn=0.5 * turn), 0.5),
            (none, 1.0),
        ):
            assert hinged.share_below(response, impulses, limits) == pytest.approx(share)


def test_two_coaxial_bubbles_spin_about_their_axis_as_their_inertias_ask():
    arm, mass = blob(3, [0.05, 0.0, 0.0])
    arm = np.concatenate([arm, arm * [1.0, -1.0, -1.0]])
    mass = np.concatenate([mass, mass])
    parts = [Part.of(-arm, 3.0 * mass), Part.of(arm, mass)]
    middles = np.array([-0.05, 0.0, 0.0]), np.array([0.05, 0.0, 0.0])
    response = HingedParts(parts, [Hinge(0, 1, np.zeros(3), *middles)]).response()
    before, beyond = response.turns[:, 0, 0] / response.compliance[0, 0]
    assert beyond == pytest.approx(0.75, rel=0.2)
    assert before == pytest.approx(beyond - 1.0, rel=1e-9)


def test_a_bubble_between_two_alike_twists_is_in_balance():
    arm, mass = blob(3, [0.0, 0.0, 0.0])
    arm = np.concatenate([arm, -arm, arm * [1.0, -1.0, -1.0], arm * [-1.0, 1.0, 1.0]])
    mass = np.concatenate([mass] * 4)
    places = [np.array([0.1 * k, 0.0, 0.0]) for k in range(3)]
    parts = [Part.of(arm + place, mass) for place in places]
    hinges = [Hinge(k, k + 1, 0.5 * (places[k] + places[k + 1]), places[k], places[k + 1]) for k in (0, 1)]
    turns = HingedParts(parts, hinges).response().turns @ np.ones(2)
    assert np.abs(turns[1]).max() < 1e-9 * np.abs(turns[0]).max()
    assert turns[0] == pytest.approx(-turns[2], rel=1e-9)


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
    compliance = np.array([[1.0 / inertia]])
    while joint.turns:
        (joint.impulse,) = impulses_after([joint], compliance, np.zeros(1), 0.0, step).tolist()
        assert joint.impulse * turns < 0.0
        joint.turn(joint.impulse / inertia * step)
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


def test_the_viscosity_of_a_neck_is_that_of_the_rate_at_which_it_unwinds_in_the_end():
    joint, rate = wound(8.0), 40.0
    viscosity = np.array([joint.most_torque / rate])
    for _ in range(200):
        (joint.impulse,) = impulses_after([joint], np.array([[1e6]]), viscosity, 0.0, 1e-3).tolist()
    assert -1e6 * joint.impulse == pytest.approx(rate, rel=1e-4)


def test_a_light_part_does_not_swing():
    joint = wound(0.5)
    for _ in range(20):
        (joint.impulse,) = impulses_after([joint], np.array([[1e12]]), np.zeros(1), 0.0, 1e-3).tolist()
        before = joint.turns
        joint.turn(1e12 * joint.impulse * 1e-3)
        assert 0.0 <= joint.turns < before or before == 0.0


def test_gas_keeps_the_torque_of_an_open_neck_up():
    closed, limp, full = wound(0.55), wound(0.3), wound(0.3)
    closed.pressure = full.pressure = 7e3
    assert closed.torque == wound(0.55).torque
    assert limp.torque < full.torque == full.most_torque


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
