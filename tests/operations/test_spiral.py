"""Spirals: what there is no length for, and what would do."""

from __future__ import annotations

import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeError

TEXT = """
format: 1
name: rope
units: cm
balloons:
  main: {size: 260, length: 40, tail: 10}
steps:
  - loop: {ring: LENGTH}
  - spiral: {bubbles: [ring], turns: 2}
"""


@pytest.mark.parametrize(
    ("length", "advice"),
    [("30", "expected at most 0.7, or 41.6 cm"), ("12", "2 turns, expected 41.6 cm")],
)
def test_fewer_turns_are_named_only_where_so_few_can_be_asked_for(length, advice):
    with pytest.raises(RecipeError) as told:
        plan(Recipe.parse(TEXT.replace("LENGTH", length)))
    assert advice in str(told.value)
