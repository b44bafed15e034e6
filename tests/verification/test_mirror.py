"""V34: what points left is the mirror image of what points right, and `mirror` exchanges both."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many
from tests.balloon.volume import volume_of

IN_A_MIRROR = np.array([1.0, -1.0, 1.0], dtype=np.float32)
FIGURE = """
format: 1
name: figure
units: cm
balloons:
  main: {size: 260, length: 34, tail: 6}
steps:
  - bubbles: {nose: 6, one: 7, other: 7}
  - STEP
  - rest: beyond
physics: {hold: 0.5}
"""
STEPS = {
    "lock": "{lock: [one, other], point: SIDE}",
    "bend": "{bend: {one: 40}, point: SIDE}",
    "fold and lock": "{fold: {far: 12}, point: SIDE}\n  - {lock: [one, other], point: SIDE}",
}
TWO_BALLOONS = """
format: 1
name: two
units: cm
balloons:
  main: {size: 260, length: 24, tail: 6}
  guest: {size: 260, length: 24, tail: 6}
steps:
  - {bubbles: {nose: 6, one: 7}, balloon: main}
  - {bubbles: {first: 6, second: 7}, balloon: guest}
  - lock: {joints: [one.end, first.end]}
  - {rest: main_rest, balloon: main}
  - {rest: guest_rest, balloon: guest}
front: right
pose: stand
physics: {hold: 0.25}
"""
PRESSED = """
format: 1
name: pressed
units: cm
fps: 8
balloons:
  main: {size: 260, capsule: 12}
steps:
  - {press: {bubble: main_rest, depth: 2}, point: left}
physics: {model: kosaka, hold: 0.25}
"""


@cache
def frames(text):
    """Points of walls and of air in every frame, (frames, N, 3), and the meshes of the balloons."""
    simulation = simulate_many([plan(Recipe.parse(text))], detail="draft", device="cpu")
    points = [np.concatenate([*frame.points, *frame.air]) for (frame,) in simulation.frames()]
    return np.stack(points), simulation.meshes[0]


@pytest.mark.parametrize(
    "step", ["lock", *(pytest.param(step, marks=pytest.mark.long) for step in ("bend", "fold and lock"))]
)
def test_what_points_left_is_the_mirror_image_of_what_points_right(verify, step):
    figures = [FIGURE.replace("STEP", STEPS[step]).replace("SIDE", side) for side in ("left", "right")]
    (left, _), (right, meshes) = (frames(text) for text in figures)
    off = 1e3 * np.linalg.norm(left * IN_A_MIRROR - right, axis=2).max()
    verify("V34", f"{step} to the left off the mirror image of that to the right, mm", off, 0.0, 0.5)
    # To which side, and not inside out.
    assert left[-1, :, 1].min() < -0.04 < 0.04 < right[-1, :, 1].max()
    assert volume_of(right[-1], meshes[0].quads) > 0.0


@pytest.mark.parametrize(
    "text",
    [pytest.param(TWO_BALLOONS, marks=pytest.mark.long), PRESSED],
    ids=["two balloons that stand", "kosaka"],
)
def test_mirror_exchanges_left_and_right_in_every_frame(text):
    as_it_is, _ = frames(text)
    mirrored, meshes = frames(text + "mirror: true\n")
    assert np.array_equal(mirrored, as_it_is * IN_A_MIRROR)
    assert np.abs(as_it_is[-1, :, 1]).max() > 0.02
    first = 0
    for mesh in meshes:
        own = mirrored[-1, first : first + len(mesh.points)]
        assert volume_of(own, mesh.quads) > 0.0
        first += len(mesh.points)


def test_what_points_right_comes_out_left_in_a_mirror():
    right = FIGURE.replace("STEP", STEPS["lock"]).replace("SIDE", "right") + "mirror: true\n"
    left = FIGURE.replace("STEP", STEPS["lock"]).replace("SIDE", "left")
    assert np.array_equal(frames(right)[0], frames(left)[0])
