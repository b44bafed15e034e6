"""Bubbles that were twisted off before are closed: an ear made in a ring of bubbles."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.plan import plan
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many
from tests.crowd.watched import crossings

RING = """\
format: 1
name: ring
units: cm
balloons:
  main: {size: 260, inflated: 32}
steps:
  - bubbles: {one: 7, knob: 2.5, other: 7}
  - lock: [one, knob, other]
  - ear: knob
  - rest: stem
"""


class Made:
    """A figure of which all frames were looked at."""

    def __init__(self, text):
        self.plan = plan(Recipe.parse(text))
        simulation = simulate_many([self.plan], detail="draft", device="cpu")
        (self.mesh,) = simulation.meshes[0]
        self.quality = QualityWatch(self.plan, [self.mesh], range(1, self.plan.frame_count + 1))
        for (self.frame,) in simulation.frames():
            self.quality.add(self.frame)

    def neck(self, bubble):
        """Middle of the neck behind a bubble in the end, (3,), m."""
        rest_end = next(each.rest_end for each in self.plan.bubbles if each.name == bubble)
        first = self.mesh.ring_start[np.argmin(np.abs(self.mesh.ring_along - rest_end))]
        return self.frame.points[0][first + np.arange(self.mesh.around)].astype(float).mean(axis=0)


@pytest.fixture(scope="module")
def ring():
    return Made(RING)


def test_its_two_ends_come_together_in_the_ring(ring):
    assert np.linalg.norm(ring.neck("one") - ring.neck("knob")) < 0.009


def test_it_is_as_hard_as_an_ear(ring):
    assert 8.0e3 < ring.frame.pressure[1] < 11.5e3


def test_no_wall_goes_through_another_in_any_frame(ring):
    assert not crossings(ring.quality)
