"""Bodies of round balloons, whole and twisted."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.detail import DETAILS
from balloon_usd.plan import plan
from balloon_usd.plan.meshing import joint_places, mesh_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.latex.round_body import round_body

TWISTED = """
format: 1
name: twisted
units: cm
balloons:
  one: {{size: R5, inflated: 10}}
steps:
{bubbles}
  - rest: last
must_hold: planned
"""
HEIGHTS = ((), (3.5,), (6,), (9.9,), (4, 7))


def twisted(heights, physics=""):
    bubbles = "\n".join(f"  - bubbles: {{b{k}: {height}}}" for k, height in enumerate(heights))
    return plan(Recipe.parse(TWISTED.format(bubbles=bubbles) + physics))


@pytest.mark.parametrize("detail", DETAILS.values(), ids=list(DETAILS))
@pytest.mark.parametrize("heights", HEIGHTS)
def test_every_place_that_hands_hold_has_a_ring_of_its_own(heights, detail):
    made = twisted(heights)
    mesh = mesh_of(made.strips["one"], detail)
    rings = [mesh.ring_at(ring.along) for ring in made.table.rings]
    assert len(set(rings)) == len(rings)
    assert rings == sorted(rings)


@pytest.mark.parametrize("heights", HEIGHTS)
def test_it_has_a_chamber_for_every_bubble_and_its_necks_hide_no_rubber(heights):
    strip = twisted(heights).strips["one"]
    mesh = mesh_of(strip, DETAILS["draft"])
    body = round_body(mesh, strip.rubber, strip.size, joint_places(strip), (), 1.0)
    assert len(body.segment_ends) == len(strip.bubbles) + 2
    assert len(body.hidden) == len(body.drawn) == len(body.segment_ends)
    assert not body.hidden.any()


def test_its_wall_is_even_but_for_its_tip_whether_or_not_it_softens():
    mesh = mesh_of(twisted(()).strips["one"], DETAILS["draft"])
    walls = []
    for physics in ("", "physics: {softening: false}\n"):
        strip = twisted((), physics).strips["one"]
        walls.append(round_body(mesh, strip.rubber, strip.size, (), (), 1.0).thickness)
    np.testing.assert_array_equal(*walls)
