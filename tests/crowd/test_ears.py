"""Ears that are folded small, one beside the other: their walls never go through each other."""

from __future__ import annotations

import pytest

from balloon_usd.plan import plan
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.simulation import simulate_many

LENGTHS = {160: 3, 260: 4, 350: 5, 646: 9}
"""Length of an ear on each size of balloon, cm: as long as wide."""


def ears(size: int, count: int) -> str:
    """The recipe of a body with so many ears in a row."""
    long = LENGTHS[size]
    steps = "".join(f"  - ear: {{ear_{n}: {long}}}\n" for n in range(count))
    inflated = 4 * long * count + 12
    return f"""
format: 1
name: ears
units: cm
balloons:
  main: {{size: {size}, inflated: {inflated}}}
steps:
  - bubbles: {{body: {2 * long}}}
{steps}  - rest: rest
"""


def crossings(text: str) -> list[int]:
    """Crossings of every frame of a recipe."""
    planned = plan(Recipe.parse(text))
    simulation = simulate_many([planned], detail="draft", device="cpu")
    quality = QualityWatch(planned, simulation.meshes[0], range(1, planned.frame_count + 1))
    for (frame,) in simulation.frames():
        assert isinstance(frame, Frame), frame
        quality.add(frame)
    return [count.count for count in quality.crossings.frames.values()]


def test_an_ear_as_long_as_wide_never_goes_through_itself():
    assert not any(crossings(ears(260, 1)))


@pytest.mark.long
@pytest.mark.parametrize("size", [160, 260, 350, 646])
def test_three_ears_in_a_row_never_go_through_each_other(size):
    assert not any(crossings(ears(size, 3)))
