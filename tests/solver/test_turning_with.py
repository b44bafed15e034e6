"""With which bubble rubber turns when joints untwist."""

from __future__ import annotations

import numpy as np

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.latex.turning_with import turning_with

TORN = """
format: 1
name: torn
units: cm
balloons:
  main: {size: 260, color: pink, length: 24, tail: 9}
steps:
  - bubbles: {before: 7}
  - ear: {first: 3}
  - bubbles: {gap: 5}
  - ear: {second: 3}
  - bubbles: {behind: 7}
  - rest: beyond
"""
POPS = "  - pop: gap\n"


def turning(text):
    """With what rubber turns at a quarter and at three quarters of every bubble."""
    made = plan(Recipe.parse(text))
    bubbles = made.strips["main"].bubbles
    places = [b.rest_start + share * b.rest_length for b in bubbles for share in (0.25, 0.75)]
    return turning_with(made, "main", np.array(places, dtype=np.float32)).tolist()


def test_rubber_turns_with_its_own_bubble():
    found = turning(TORN)
    names = [name for name in ("before", "first", "gap", "second", "behind", "beyond") for _ in range(2)]
    assert found == names


def test_each_rag_of_a_popped_bubble_turns_with_what_hangs_on_its_joint():
    found = turning(TORN + POPS)
    assert found[:6] == ["before", "before", "first", "first", "before", "second"]
    assert found[6:] == ["second", "second", "behind", "behind", "beyond", "beyond"]


def test_what_a_tear_has_parted_does_not_turn_with_what_unwinds_beyond_it():
    made = plan(Recipe.parse(TORN + POPS))
    (loose,) = made.loose
    assert str(loose.end) == "behind.end"
    assert loose.before | loose.beyond == {"second", "behind", "beyond"}
