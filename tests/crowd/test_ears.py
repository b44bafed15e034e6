"""Ears that are folded small: their walls never go through themselves, nor through each other."""

from __future__ import annotations

import pytest

from balloon_usd.recipe import Recipe
from tests.crowd.watched import crossings, watched

EAR = """
format: 1
name: ear
units: cm
balloons:
  main: {size: 260, inflated: 28}
steps:
  - bubbles: {body: 8}
  - ear: {ear: 4}
  - rest: rest
"""
IN_A_ROW = """
format: 1
name: in_a_row
units: cm
balloons:
  main: {{size: {size}, inflated: {inflated}}}
steps:
  - bubbles: {{body: {body}}}
  - ear: {{first: {ear}}}
  - ear: {{second: {ear}}}
  - ear: {{third: {ear}}}
  - rest: rest
"""


def test_an_ear_as_long_as_wide_never_goes_through_itself():
    assert not crossings(watched(Recipe.parse(EAR)))


@pytest.mark.long
@pytest.mark.parametrize(
    ("size", "inflated", "body", "ear"),
    [(160, 48, 6, 3), (260, 54, 8, 4), (350, 60, 10, 5), (646, 60, 18, 9)],
)
def test_three_ears_in_a_row_never_go_through_each_other(size, inflated, body, ear):
    text = IN_A_ROW.format(size=size, inflated=inflated, body=body, ear=ear)
    quality = watched(Recipe.parse(text))
    assert not crossings(quality)
    found = quality.data()
    assert found is not None
    assert found["joints"]["lost"] == []
