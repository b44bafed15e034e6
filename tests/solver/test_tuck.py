"""`tuck`: limbs set between others, whose walls hold them."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.operations.tuck import Tuck
from balloon_usd.quality.astride import ASTRIDE, Tube, share_between, share_in_hole
from tests.solver.into_ring import IntoRing

HELD = "physics: {hold: 2}\n"
SLOWLY = "tempo: show\n"
WHEEL = """
format: 1
name: wheel
units: cm
balloons:
  main: {{size: 260, length: 14.5, tail: 6}}
steps:
  - bubbles: {{axle: 6}}
  - loop: {{tyre: {tyre}}}
  - ear: {{hub: 4}}
  - tuck: {{bubble: hub, between: [tyre]}}
"""
PENGUIN = """
format: 1
name: penguin
units: in
balloons:
  white: {size: 260, length: 3, tail: 1.5}
  black: {size: 260, length: 4, tail: 2}
steps:
  - bubbles: {left_eye: 1.5, right_eye: 1.5}
    balloon: white
  - {rest: spare, balloon: white}
  - lock: [left_eye, right_eye]
  - cut: spare
  - bubbles: {cap: 1.5}
    balloon: black
  - lock: {joints: [cap.end, right_eye.end]}
  - tuck: {bubble: cap, between: [left_eye, right_eye]}
"""


def ball(x: float, y: float = 0.0, z: float = 0.0) -> Tube:
    return Tube(np.array([[x, y, z]]), np.array([1.0]))


def circle(radius: float) -> Tube:
    turn = np.linspace(0.0, 2.0 * np.pi, 48, endpoint=False)
    middles = radius * np.stack([np.cos(turn), np.sin(turn), 0.0 * turn], axis=1)
    return Tube(middles, np.ones(48))


def test_a_ball_between_two_is_half_a_turn_from_one_to_the_other_and_on_two_a_third_of_it():
    one, other = ball(-1.0), ball(1.0)
    assert share_between(ball(0.0, np.sqrt(3.0)), one, other) == pytest.approx(1.0 / 3.0)
    assert share_between(ball(0.0), ball(-2.0), ball(2.0)) == pytest.approx(1.0)
    assert share_between(ball(0.0, 4.0), one, other) == 0.0
    assert share_between(ball(3.0), ball(1.0), ball(-1.0)) == 0.0


def test_a_ball_in_the_plane_of_a_loop_sees_it_in_half_of_all_directions():
    loop = circle(2.0)
    heights = (0.0, 1.0, 2.0)
    shares = [share_in_hole(ball(0.0, 0.0, z), loop) for z in heights[:2]]
    assert shares == pytest.approx([0.5 - 0.5 * z / np.hypot(z, 2.0) for z in heights[:2]], abs=2e-3)
    assert share_in_hole(ball(0.0, 0.0, heights[2]), loop) == 0.0


@pytest.fixture(scope="module")
def duck():
    return IntoRing(Tuck.example + HELD)


def test_wings_hold_a_neck_that_is_laid_between_them(duck):
    assert duck.stuck == duck.slipped == []
    assert duck.result["through"]["neck"] > 0.4
    assert not any(duck.crossings)


def test_it_lies_along_them_and_stays_where_it_is(duck):
    ways = [duck.middle(name, at) for at in (-1, -20) for name in ("neck", "left_wing", "right_wing")]
    neck, left, right, before, *_ = ways
    assert np.linalg.norm(neck - 0.5 * (left + right)) < 1.1 * duck.move.width
    assert np.linalg.norm(neck - before) < 1e-3


def test_an_ear_stays_in_the_hole_of_a_loop_and_slips_out_of_a_closed_one():
    wheel = IntoRing(WHEEL.format(tyre=20) + SLOWLY + HELD)
    assert wheel.stuck == wheel.slipped == []
    assert wheel.result["through"]["hub"] > 0.3
    assert not any(wheel.crossings)
    closed = IntoRing(WHEEL.format(tyre=15) + SLOWLY + HELD)
    (told,) = (*closed.stuck, *closed.slipped)
    assert told.startswith(("hub did not come into tyre: ", "hub slipped out of tyre at "))
    assert closed.result["through"]["hub"] < ASTRIDE
    assert closed.result["verdict"] == "off"


@pytest.mark.long
def test_a_ball_of_another_balloon_sits_astride_a_pair():
    made = IntoRing(PENGUIN + SLOWLY + HELD)
    assert made.stuck == made.slipped == []
    assert 0.3 < made.result["through"]["cap"] < 0.7
    assert not any(made.crossings)
