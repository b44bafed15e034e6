"""Cautions of bubbles between which a limb is set, and which do not meet where it hangs."""

from __future__ import annotations

import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe

LEGS = """
format: 1
name: legs
units: cm
balloons:
  main: {size: 260, length: 60, tail: 20}
steps:
  - bubbles: {head: 6, left_front: 8, right_front: 8}
  - lock: [left_front, right_front]
  - bubbles: {body: 9, left_hind: 8, right_hind: 8}
  - lock: [left_hind, right_hind]
  - loop: {wheel: 24}
  - rest: tail
"""


def told(bubble, *between):
    step = f"  - tuck: {{bubble: {bubble}, between: [{', '.join(between)}]}}\n"
    cautions = plan(Recipe.parse(LEGS + step)).cautions
    return [each for each in cautions if "may not come" in each.what]


@pytest.mark.parametrize(
    "names",
    [
        ("head", "left_front", "right_front"),
        ("tail", "left_hind", "right_hind"),
        ("tail", "left_hind", "wheel"),
        ("tail", "wheel"),
    ],
)
def test_nothing_is_told_of_what_meets_where_the_limb_hangs(names):
    assert not told(*names)


def test_bubbles_that_share_no_joint_are_told():
    (caution,) = told("head", "left_front", "right_hind")
    assert caution.step == 6
    assert caution.what == "head may not come between left_front and right_hind"
    assert caution.why == "these share no joint, and so do not close on what is between them"


def test_bubbles_that_meet_at_another_joint_are_told_with_how_far_that_is():
    (caution,) = told("head", "left_hind", "right_hind")
    assert caution.why == "head is turned about a joint that is 9 cm from their joint"
    assert "lock both joints together before" in caution.remedy


def test_a_loop_that_hangs_elsewhere_is_told():
    (caution,) = told("head", "wheel")
    assert caution.what == "head may not come into wheel"
    assert caution.why == "head is turned about a joint that is 9 cm from its joint"


def test_joints_that_are_locked_together_are_one():
    locked = LEGS + "  - lock: {joints: [head.end, body.end]}\n"
    step = "  - tuck: {bubble: head, between: [left_hind, right_hind]}\n"
    cautions = plan(Recipe.parse(locked + step)).cautions
    assert not any("may not come" in each.what for each in cautions)
