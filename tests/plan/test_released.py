"""Cautions of bubbles that a popped one had held."""

from __future__ import annotations

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe

SWORD = """
format: 1
name: sword
units: cm
balloons:
  main: {size: 260, inflated: 100, length: 40}
steps:
  - bubbles: {pommel: 5}
  - ear: {stop: 3}
  - loop: {guard: 16}
  - rest: blade
  - thread: {bubble: blade, through: [guard]}
"""


def released(text):
    """Return what the plan says is held no more."""
    return [caution for caution in plan(Recipe.parse(text)).cautions if "held no more" in caution.what]


def test_what_was_threaded_through_a_ring_that_is_popped_later_is_held_no_more():
    (caution,) = released(f"{SWORD}  - pop: guard\n")
    assert caution.what == "blade is held no more once guard is popped"
    assert caution.why == "step 5 threads blade through guard"
    assert caution.step == 5


def test_where_nothing_was_brought_through_what_is_popped_there_is_no_caution():
    assert released(SWORD) == []
    assert (
        released(SWORD.replace("  - thread: {bubble: blade, through: [guard]}\n", "  - pop: guard\n")) == []
    )
    assert released(f"{SWORD}  - pop: stop\n") == []
