"""Bubbles pushed and rolled into rings: the walls of the ring hold them, or they slip out."""

from __future__ import annotations

import re
from itertools import pairwise

import numpy as np
import pytest

from balloon_usd.language.joint import Joint
from balloon_usd.operations.push import Push
from balloon_usd.operations.roll import Roll
from balloon_usd.solver.latex.motions.into_ring import RingPlane
from tests.solver.into_ring import IntoRing

HELD = "physics: {hold: 2}\n"
LOOP = """
format: 1
name: looped
units: cm
balloons:
  main: {{size: 260, length: 24, tail: 9}}
steps:
  - bubbles: {{nose: {nose}}}
  - loop: {{hair: {hair}}}
    point: up
  - push: {{bubble: nose, through: [hair]}}
"""
BEFORE = """
format: 1
name: before
units: cm
balloons:
  main: {size: 260, length: 16, tail: 8}
steps:
  - bubbles: {first: 3, nose: 6, left_ear: 7, right_ear: 7}
  - lock: [left_ear, right_ear]
  - roll: {bubble: nose, between: [left_ear, right_ear]}
"""
OTHER = """
format: 1
name: other
units: cm
balloons:
  main: {size: 260, length: 16, tail: 9}
  more: {size: 260, length: 5, inflated: 6}
steps:
  - bubbles: {nose: 3, left: 7, right: 7}
    balloon: main
  - lock: [left, right]
  - rest: arm
    balloon: more
  - lock: {joints: [arm.start, left.start]}
  - push: {bubble: arm, through: [left, right]}
"""
MARRIED = """
format: 1
name: married
units: cm
balloons:
  one: {size: 260, length: 12, tail: 6}
  two: {size: 260, length: 12, tail: 6}
steps:
  - {bubbles: {b1: 8, b2: 8}, balloon: two}
  - {marriage: {bubbles: {a1: 8, a2: 8}, to: [b1, b2]}, balloon: one}
"""
MEATBALL = """
format: 1
name: meatball
units: cm
balloons:
  main: {size: 260, length: 17, tail: 8}
steps:
  - bubbles: {a: 6, b: 6}
  - lock: [a, b]
    point: up
  - bubbles: {c: 6, d: 6}
  - lock: [c, d]
    point: down
  - roll: {bubble: c, between: [a, b]}
"""


@pytest.fixture(scope="module")
def pushed():
    return IntoRing(Push.example + HELD)


@pytest.fixture(scope="module")
def rolled():
    return IntoRing(Roll.example + HELD)


def test_a_nose_that_is_pushed_between_ears_is_held_there_when_hands_let_go(pushed):
    assert pushed.slipped == []
    assert pushed.result["through"]["nose"] > 0.75
    assert np.linalg.norm(pushed.middle("nose") - pushed.middle("nose", -24)) < 1e-3


def test_it_points_where_it_pointed_and_the_ears_have_gone_over_it(pushed):
    joint = pushed.mesh.ring_at(pushed.plan.table.rings[pushed.move.base].along)
    before, after = (pushed.middle("nose", at) - pushed.middles[at][joint] for at in (0, -1))
    ears = [pushed.middle(ear) - pushed.middles[-1][joint] for ear in ("left_ear", "right_ear")]
    assert before @ after > 0.8 * np.linalg.norm(before) * np.linalg.norm(after)
    assert max(ear[2] for ear in ears) < after[2]


@pytest.mark.parametrize("made", ["pushed", "rolled"])
def test_no_wall_goes_through_another_on_the_way(made, request):
    assert max(request.getfixturevalue(made).crossings) == 0


@pytest.mark.parametrize("made", ["pushed", "rolled"])
def test_every_bubble_keeps_its_gas_on_the_way(made, request):
    gas = request.getfixturevalue(made).gas
    if made == "pushed":
        np.testing.assert_allclose(gas[-1], gas[0], rtol=1e-6)
    else:
        assert gas[-1].sum() == pytest.approx(gas[0].sum(), rel=1e-6)


def test_the_three_bubbles_of_a_bird_lie_side_by_side_in_a_triangle(rolled):
    assert rolled.slipped == []
    middles = [rolled.middle(name) for name in ("left", "right", "belly")]
    sides = [np.linalg.norm(one - other) for one, other in pairwise([*middles, middles[0]])]
    # What follows lies between their far ends, and holds them a little apart.
    assert min(sides) > 0.9 * rolled.move.width
    assert max(sides) < 1.45 * rolled.move.width
    assert max(sides) < 1.2 * min(sides)


def test_the_twist_behind_a_rolled_bubble_does_not_come_undone(rolled):
    assert rolled.plan.loose == ()
    joint = rolled.plan.table.rings[rolled.plan.table.joint(Joint("belly", "end"))]
    row = rolled.mesh.ring_at(joint.along)
    neck = rolled.rings[row] - rolled.middles[-1][row]
    assert np.linalg.norm(neck, axis=1).mean() < 0.15 * rolled.move.width


@pytest.mark.long
def test_a_nose_that_is_longer_than_its_ring_is_deep_gets_stuck_as_the_plan_warns():
    made = IntoRing(LOOP.format(nose=14, hair=15) + HELD)
    assert made.stuck == ["nose did not come into its ring: make the bubble smaller or the ring larger"]
    assert made.slipped == []
    assert made.result["slipped"] == ["nose"]
    (caution,) = made.plan.cautions
    assert "nose (14 cm) may not come through hair" in caution.what


@pytest.mark.long
def test_a_bubble_before_its_ring_is_rolled_with_what_hangs_on_it():
    made = IntoRing(BEFORE + HELD)
    assert made.move.base == made.plan.table.joint(Joint("nose", "end"))
    assert made.stuck == made.slipped == []
    assert made.result["through"]["nose"] > 0.7


@pytest.mark.long
def test_a_bubble_of_another_balloon_that_was_led_in_from_the_side_goes_through():
    made = IntoRing(OTHER + HELD)
    assert made.stuck == made.slipped == []
    assert made.result["through"]["arm"] > 0.6


@pytest.mark.long
@pytest.mark.parametrize(
    ("text", "rolled"),
    [(MARRIED, "a2"), (MEATBALL, "c")],
    ids=["marriage", "meatball"],
)
def test_pairs_are_passed_through_each_other(text, rolled):
    made = IntoRing(text + HELD)
    assert made.stuck == made.slipped == []
    assert made.result["through"][rolled] > 0.75
    assert not any(made.crossings)


@pytest.mark.parametrize("slant", [-0.09, -0.01, 0.01, 0.09])
def test_a_bubble_behind_its_ring_swings_over_the_side_that_it_is_nearer_to(slant):
    ring = 0.03 * np.array([[1.0, 1.0, 0.0], [2.0, 0.0, 0.0], [1.0, -1.0, 0.0]])
    plane = RingPlane.of(ring, np.array([-np.sqrt(1.0 - slant**2), 0.0, slant]))
    assert plane.normal[2] == pytest.approx(np.sign(slant))


def test_where_the_ring_comes_undone_as_planned_nothing_is_expected_to_stay():
    made = IntoRing(Push.example.replace("    point: up\n", "    point: up\n    turns: 1\n") + HELD)
    assert made.result["verdict"] == "none"


def test_a_nose_that_is_too_small_for_its_ring_slips_out_and_when_is_told():
    made = IntoRing(LOOP.format(nose=3, hair=36) + HELD)
    (told,) = made.slipped
    time = float(re.match(r"nose slipped out of its ring at ([\d.]+) s: ", told).group(1))
    assert made.move.end - 0.1 < time <= made.times[-1]
    assert made.result["value"] == 1
    assert made.result["verdict"] == "off"
