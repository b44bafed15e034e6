"""Tied ends of latex: a hoop of what is left of a tube, closed at its front and tied by its flat tip."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.plan import plan
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

HOOP = """
format: 1
name: hoop
units: cm
balloons: {main: {size: 260, length: 13, tail: 4}}
physics: {friction: 0.05, hold: 2}
steps:
  - rest: ring
  - tie: {end: ring.end, to: ring.start}
"""


class Tied:
    """All frames of the hoop."""

    def __init__(self):
        self.plan = plan(Recipe.parse(HOOP))
        self.simulation = simulate_many([self.plan], device="cpu")
        self.mesh = self.simulation.meshes[0][0]
        self.frames = [frame.copy() for (frame,) in self.simulation.frames()]

    def around(self, along):
        """The last places of the ring of vertices nearest to an unstressed distance (m) from the knot, (N, 3), m."""
        start = int(self.mesh.ring_start[np.argmin(np.abs(self.mesh.ring_along - along))])
        return self.frames[-1].points[0][start : start + self.mesh.around].astype(float)


@pytest.fixture(scope="module")
def tied():
    return Tied()


def test_its_ends_stay_together_however_slippery_it_is(tied):
    ring, _ = tied.plan.strips["main"].bubbles
    end, start = (tied.around(along).mean(axis=0) for along in (ring.rest_end, 0.0))
    apart = np.linalg.norm(end - start)
    assert apart < 0.25 * tied.plan.strips["main"].inflated_radius
    assert tied.frames[-1].undone == ()


def test_its_gas_is_in_the_ring_and_none_in_the_tip(tied):
    ring, tip = tied.frames[-1].volume
    planned = [bubble.volume for bubble in tied.plan.strips["main"].bubbles]
    assert ring == pytest.approx(planned[0], rel=0.05)
    assert tip < 0.02 * ring


def test_its_tip_is_as_thin_as_a_flat_tail(tied):
    strip = tied.plan.strips["main"]
    points = tied.around(0.5 * (strip.bubbles[-1].rest_start + strip.bubbles[-1].rest_end))
    wide = np.linalg.norm(points - points.mean(axis=0), axis=1).mean()
    assert wide < 1.4 * strip.size.radius


def test_no_wall_goes_through_another(tied):
    counter = CrossingCounter(walls_of(tied.plan, tied.simulation.meshes[0]), 100)
    assert all(counter.count(frame.points).count == 0 for frame in tied.frames[::6])
