"""What is left of a balloon may be as short as its round tip, and have no tail."""

from __future__ import annotations

from balloon_usd.plan import plan
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

SHORT = """
format: 1
name: short
units: cm
balloons:
  main: {size: 260, length: 6.12, tail: 0.4}
steps:
  - bubbles: {head: 16}
  - rest: end
"""


def test_it_is_pinched_off_and_no_wall_folds():
    made = plan(Recipe.parse(SHORT))
    end = made.strips["main"].bubbles[-1]
    assert 3.5 < end.rest_length / made.strips["main"].size.radius < 4.5
    simulation = simulate_many([made], device="cpu")
    (meshes,) = simulation.meshes
    counter = CrossingCounter(walls_of(made, meshes), 100)
    for (frame,) in simulation.frames():
        assert max(stretch.max() for stretch in frame.stretch) < 8.0
        if frame.time_code % 6 == 0:
            assert counter.count(frame.points).count == 0
    assert frame.time_code == made.frame_count
