"""Ears that are folded small: their walls never go through themselves."""

from __future__ import annotations

from balloon_usd.plan import plan
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.simulation import simulate_many

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
    assert not any(crossings(EAR))
