"""How far reaches what hands turn or bring, and the time that they take for it."""

from __future__ import annotations

import pytest

from balloon_usd.operations.moves import Aim, Bend, Bring, Tuck
from balloon_usd.operations.score import BRING_SECONDS, BRING_SPEED
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe

LIMB = """
format: 1
name: limb
units: cm
balloons: {main: {size: 260, length: 60, tail: 14}}
steps:
  - bubbles: {head: 5, left: 7, right: 7}
  - lock: [left, right]
  - bubbles: {arm: 3}
  - ear: {hand: 3}
"""
RINGS = """
format: 1
name: rings
units: cm
balloons:
  m: {size: 260, length: 40, tail: 8}
  n: {size: 260, length: 40, tail: 8}
steps:
  - bubbles: {a: 3, al: LONG}
    balloon: m
  - bubbles: {b: 3, bl: LONG}
    balloon: n
  - lock: {joints: [al.end, bl.start]}
  - lock: {joints: [bl.end, al.start]}
"""


def moves(text, kind):
    return [move for move in plan(Recipe.parse(text)).choreography.moves if isinstance(move, kind)]


def length(text, bubble):
    made = plan(Recipe.parse(text))
    return next(b.length for strip in made.strips.values() for b in strip.bubbles if b.name == bubble)


def test_a_limb_is_turned_in_three_seconds_for_each_metre_that_it_reaches_from_its_joint():
    text = LIMB + "  - rest: spear\n  - aim: {arm: forward}\n"
    (move,) = moves(text, Aim)
    assert move.seconds == pytest.approx(3.0 * (0.03 + length(text, "spear")))


def test_what_is_left_of_a_balloon_counts_as_long_as_it_is_by_then():
    aim, more = "  - aim: {arm: forward}\n", "  - bubbles: {more: 40}\n  - rest: spear\n"
    (move,) = moves(LIMB + aim + more, Aim)
    left = 0.4 + length(LIMB + aim + more, "spear")
    assert move.seconds == pytest.approx(3.0 * (0.03 + left))


def test_a_bend_swings_what_hangs_on_the_end_on_which_less_does():
    text = LIMB.replace("left: 7", "neck: 30, wrist: 9, left: 7")
    (light,) = moves(text + "  - rest: spear\n  - bend: {spear: 90}\n", Bend)
    assert light.seconds == pytest.approx(0.9)
    (heavy,) = moves(text + "  - rest: spear\n  - bend: {wrist: 180}\n", Bend)
    assert heavy.seconds == pytest.approx(3.0 * 0.35)


def test_a_tuck_takes_longer_with_what_hangs_on_its_limb():
    tuck = "  - rest: spear\n  - tuck: {bubble: neck, between: [left, right]}\n"
    near, far = (
        moves(LIMB.replace("head: 5,", f"head: {head}, neck: 4,") + tuck, Tuck)[0].seconds for head in (5, 60)
    )
    assert near == pytest.approx(2.4)
    assert far == pytest.approx(6.0 * 0.64)


def test_a_joint_is_brought_round_a_large_ring_no_faster_than_half_a_metre_a_second():
    (small,) = moves(RINGS.replace("LONG", "20"), Bring)[1:]
    (large,) = moves(RINGS.replace("LONG", "50"), Bring)[1:]
    assert small.seconds == BRING_SECONDS
    assert large.seconds == pytest.approx(1.0 / BRING_SPEED, rel=0.02)


def test_a_bend_in_a_blink_is_refused_with_the_least_time():
    with pytest.raises(Exception, match=r"0\.3 s are too short a time to bend tip, expected at least 0\.5 s"):
        plan(Recipe.parse(LIMB + "  - rest: tip\n  - bend: {tip: 90}\n    seconds: 0.3\n"))
