"""Which rubber lies in which neck."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.detail import DETAILS
from balloon_usd.plan import plan
from balloon_usd.plan.meshing import made_meshes
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.joints import joints_of
from balloon_usd.quality.ring_corners import RingCorners
from balloon_usd.quality.walls import Side, neck_reach, walls_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame

AROUND = 12
SHORT = """
format: 1
name: short
units: cm
balloons:
  {balloon}
steps:
  - bubbles: {{first: {first}, second: {second}}}
  - rest: last
must_hold: planned
"""
TUBE = SHORT.format(balloon="one: {size: 260, length: 14, tail: 6}", first=2, second=2)
ROUND = SHORT.format(balloon="one: {size: R5, inflated: 9}", first=4, second=6.5)


def side(ring, beyond, before):
    """A neck of some radius, with rubber beyond it and before it up to some distances from its middle, m."""
    turn = 2.0 * np.pi * np.arange(AROUND) / AROUND
    circle = np.stack([np.zeros(AROUND), np.cos(turn), np.sin(turn)], axis=1)
    rubber = np.array([[1.0, 0.0, 0.0], [0.5, 0.0, 0.0]])
    points = np.concatenate([ring * circle, beyond * rubber, -before * rubber])
    count = np.arange(len(points))
    return Side(count[:AROUND], count[AROUND:-2], count[-2:]), points


def test_what_is_drawn_into_a_closed_neck_is_cut_off():
    stub, points = side(ring=0.0025, beyond=0.0025, before=0.03)
    assert stub.is_cut_off(points)


def test_what_hangs_on_a_closed_neck_is_not():
    bubble, points = side(ring=0.0025, beyond=0.04, before=0.03)
    assert not bubble.is_cut_off(points)


def test_what_lies_before_a_neck_that_has_opened_again_is_not():
    bubble, points = side(ring=0.04, beyond=0.045, before=0.08)
    assert not bubble.is_cut_off(points)


@pytest.mark.parametrize("text", [TUBE, ROUND], ids=["tube", "round"])
def test_rubber_between_two_near_necks_lies_in_the_nearer_one(text):
    made = plan(Recipe.parse(text))
    (mesh,) = meshes = made_meshes(made, DETAILS["draft"])
    walls = walls_of(made, meshes)
    rings = [
        (made.table.rings[ring].along, joint)
        for joint, group in enumerate(joints_of(made))
        for ring in group.rings
    ]
    reach = neck_reach(made.strips["one"])
    for vertex in np.flatnonzero(walls.neck >= 0):
        along = max(float(mesh.along[vertex]), 0.0)
        away = {joint: abs(place - along) for place, joint in rings}
        assert away[walls.neck[vertex]] == pytest.approx(min(away.values()), abs=1e-9)
        assert away[walls.neck[vertex]] <= reach


def test_what_crosses_well_away_from_the_joint_of_a_round_balloon_is_no_rubber_folded_in_its_neck():
    made = plan(Recipe.parse(ROUND))
    (mesh,) = meshes = made_meshes(made, DETAILS["draft"])
    joint = made.bubbles[0].rest_end
    away = np.abs(np.abs(mesh.along - joint) - 0.7 * made.strips["one"].size.radius)
    vertex = int(np.argmin(away))
    points = mesh.points.copy()
    # Through the wall on the other side of the balloon.
    points[vertex, 1:] *= -1.5
    assert CrossingCounter(walls_of(made, meshes), 1).count([points]).count > 0


PAIR = """
format: 1
name: pair
units: cm
balloons:
  one: {size: 260, inflated: 40}
steps:
  - bubbles: {head: 6, left: 10, right: 10}
  - lock: [left, right]
    turns: %s
  - rest: tail
"""


@pytest.mark.parametrize(("turns", "slips"), [(1, True), (3, False)])
def test_a_lock_that_is_meant_to_slip_is_one_joint_as_long_as_hands_hold_it(turns, slips):
    planned = plan(Recipe.parse(PAIR % turns))
    (mesh,) = made_meshes(planned, DETAILS["draft"])
    walls = walls_of(planned, [mesh])
    ends = [planned.table.ends("left")[0], planned.table.ends("right")[1]]
    first, last = (RingCorners.of(planned, [mesh], ring).vertices for ring in ends)
    held = walls.held()
    assert len(set(held[first]) | set(held[last])) == 1
    assert (set(walls.neck[first]) != set(walls.neck[last])) == slips


@pytest.mark.parametrize(("apart", "together"), [(0.2, True), (0.3, False)])
def test_when_hands_have_let_go_it_is_one_as_long_as_its_necks_lie_side_by_side(apart, together):
    planned = plan(Recipe.parse(PAIR % 1))
    (mesh,) = made_meshes(planned, DETAILS["draft"])
    walls = walls_of(planned, [mesh])
    ends = [planned.table.ends("left")[0], planned.table.ends("right")[1]]
    first, last = (np.r_[RingCorners.of(planned, [mesh], ring).vertices] for ring in ends)
    points = mesh.points.copy()
    points[last] += points[first].mean(axis=0) - points[last].mean(axis=0)
    points[last, 0] += apart * planned.strips["one"].inflated_radius
    ones = np.ones(len(planned.bubbles), dtype=np.float32)
    let_go = walls.let_go(Frame(1, (points,), (np.ones(len(points), np.float32),), ones, ones, "hold"))
    assert (let_go[first[0]] == let_go[last[0]]) == together
