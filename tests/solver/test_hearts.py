"""Hearts that hang on figures."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.operations.moves import Aim
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.latex.motions.heart_face import faced
from balloon_usd.solver.simulation import simulate_many

FIGURE = """
format: 1
name: figure
units: cm
tempo: brisk
balloons:
  body: {{size: 260, length: 9, tail: 4}}
  love: {{size: H6, inflated: 12}}
steps:
  - bubbles: {{left: 8, right: 8}}
    balloon: body
  - lock: [left, right]
  - {{rest: heart, balloon: love}}
  - tie: {{end: heart.start, to: left.start}}
  - aim: {{heart: {way}}}
    spin: {spin}
"""
AIMED = (("up", 0, (0, 1, 0)), ("up", 90, (1, 0, 0)), ("left", 0, (0, 0, 1)), ("forward", 0, (0, 1, 0)))


@pytest.fixture(scope="module")
def aimed():
    """Plan, mesh of the heart and its points when hands have aimed it, of each of `AIMED`."""
    plans = [plan(Recipe.parse(FIGURE.format(way=way, spin=spin))) for way, spin, _ in AIMED]
    simulation = simulate_many(plans, device="cpu")
    ends = [next(move.end for move in each.choreography.moves if isinstance(move, Aim)) for each in plans]
    made: list[tuple] = [()] * len(plans)
    for frames in simulation.frames():
        for k, (each, frame) in enumerate(zip(plans, frames, strict=True)):
            if not made[k] and frame.time_code >= ends[k] * each.recipe.fps:
                made[k] = (each, simulation.meshes[k][1], frame.points[1].astype(float))
        if all(made):
            break
    return made


@pytest.mark.parametrize(("number", "lobes"), [(k, lobes) for k, (_, _, lobes) in enumerate(AIMED)])
def test_a_heart_that_is_aimed_shows_its_face_and_spin_turns_it_from_there(aimed, number, lobes):
    _, mesh, points = aimed[number]
    ring = int(mesh.ring_start[mesh.ring_at(0.7 * mesh.ring_along[-1])])
    across = points[ring] - points[ring + mesh.around // 2]
    assert abs(across @ lobes) / np.linalg.norm(across) > np.cos(np.radians(20.0))


def test_it_faces_forward_and_up_where_it_points_forward_or_back():
    for way in ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (0.5, 0.7, 0.5)):
        assert faced(np.array(way)) == pytest.approx([-1.0, 0.0, 0.0])
    for way in ((1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)):
        assert faced(np.array(way)) == pytest.approx([0.0, 0.0, 1.0])
