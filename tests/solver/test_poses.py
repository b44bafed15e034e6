"""Finished figures are put where their recipes say."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from balloon_usd.balloon.air import MOLAR_MASS, OUTSIDE_DENSITY
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.latex.weight import rigid_figure
from balloon_usd.solver.simulation import simulate_many

STOOL = """
format: 1
name: stool
units: cm
balloons:
  main: {size: 260, length: 12, tail: 6}
steps:
  - inflate: main
    seconds: 0.5
  - bubbles: {front: 4, left_leg: 6, right_leg: 6}
    seconds: 1.5
  - lock: [left_leg, right_leg]
    point: down
    seconds: 1.5
  - rest: back
pose: POSE
symmetric: false
physics: {hold: 0.5}
"""


@cache
def made(pose):
    """Make a figure; return its points, (V, 3), m, in every frame from the last of its making on, and what
    the hands did last.
    """
    simulation = simulate_many([plan(Recipe.parse(STOOL.replace("POSE", pose)))], device="cpu")
    doing, points = [], []
    for (frame,) in simulation.frames():
        doing.append(frame.doing)
        points.append(np.concatenate(frame.points).astype(float))
    last = max(k for k, text in enumerate(doing) if text == "hold")
    return np.array(points[last:]), doing[-1], simulation.model.performers[0].sculpture


def test_a_figure_stays_where_it_was_made_without_a_pose():
    points, doing, sculpture = made("as made")
    assert (len(points), doing, sculpture.placed) == (1, "hold", None)


@pytest.mark.parametrize("pose", ["stand", "hang", "hold"])
def test_hands_carry_the_figure_as_it_is_gently(pose):
    points, _, _ = made(pose)
    assert len(points) > 60
    some = points[:, ::97]
    sizes = np.linalg.norm(some[:, :, None] - some[:, None], axis=3)
    assert np.abs(sizes - sizes[0]).max() < 2e-3
    steps = np.linalg.norm(np.diff(points, axis=0), axis=2).max(axis=1)
    assert steps.max() * 24.0 < 2.0
    assert max(steps[0], *steps[-20:]) < 1e-3


def test_a_figure_stands_on_the_ground_with_its_middle_over_the_origin():
    points, doing, sculpture = made("stand")
    low, high = points[-1].min(axis=0), points[-1].max(axis=0)
    assert doing == "stand"
    assert low[2] == pytest.approx(0.0, abs=5e-4)
    assert (low + high)[:2] == pytest.approx([0.0, 0.0], abs=2e-3)
    touching = points[-1][points[-1][:, 2] < 2e-3][:, :2]
    centre = sculpture.centre(points[-1])[:2]
    assert (touching.min(axis=0) < centre + 1e-3).all()
    assert (touching.max(axis=0) > centre - 1e-3).all()


def test_a_figure_hangs_below_the_thread_at_the_origin():
    points, doing, sculpture = made("hang")
    centre = sculpture.centre(points[-1])
    assert doing == "hang"
    assert centre[:2] == pytest.approx([0.0, 0.0], abs=2e-3)
    assert centre[2] < -5e-3


@pytest.mark.parametrize(
    ("front", "sign", "axis"), [("back", -1, 0), ("left", 1, 1), ("right", -1, 1), ("up", -1, 2)]
)
def test_a_figure_is_turned_so_that_its_front_faces_where_others_begin(front, sign, axis):
    points, doing, _ = made(f"hold\nfront: {front}")
    assert doing == "held"
    before, after = (points[k] - points[k].mean(axis=0) for k in (0, -1))
    assert after[:, 0] == pytest.approx(sign * before[:, axis], abs=4e-3)
    if axis < 2:
        assert after[:, 2] == pytest.approx(before[:, 2], abs=4e-3)


@pytest.mark.parametrize(
    ("top", "sign", "axis"), [("forward", -1, 0), ("back", 1, 0), ("left", -1, 1), ("down", -1, 2)]
)
def test_a_figure_is_turned_so_that_its_top_is_up(top, sign, axis):
    points, doing, _ = made(f"hold\ntop: {top}")
    assert doing == "held"
    before, after = (points[k] - points[k].mean(axis=0) for k in (0, -1))
    assert after[:, 2] == pytest.approx(sign * before[:, axis], abs=4e-3)
    if axis == 0:
        # What was below, or above, is the front then.
        assert after[:, 0] == pytest.approx(-sign * before[:, 2], abs=4e-3)
    else:
        assert after[:, 0] == pytest.approx(before[:, 0], abs=4e-3)


def middles(points, sculpture):
    """Where its bubbles are from the middle of a figure, by their names; points: (V, 3), m."""
    found = {}
    for bubble in sculpture.plan.bubbles:
        body, faces = sculpture.faces(bubble.name)
        own = np.unique(sculpture.scene.bodies[body].quads[faces])
        found[bubble.name] = points[own].mean(axis=0) - points.mean(axis=0)
    return found


def test_bubbles_that_are_its_top_come_up():
    points, _, sculpture = made("hold\ntop: [left_leg, right_leg]")
    lies = middles(points[-1], sculpture)
    legs = lies["left_leg"] + lies["right_leg"]
    assert legs[:2] == pytest.approx([0.0, 0.0], abs=3e-3)
    assert legs[2] > 0.02


@pytest.mark.parametrize("mirror", ["", "\nmirror: true"])
def test_a_bubble_that_is_its_front_faces_ahead_as_far_as_its_top_lets_it(mirror):
    points, _, sculpture = made(f"hold\ntop: [left_leg, right_leg]\nfront: back{mirror}")
    points = points[-1] * [1.0, -1.0 if mirror else 1.0, 1.0]
    lies = middles(points, sculpture)
    legs = lies["left_leg"] + lies["right_leg"]
    assert legs[:2] == pytest.approx([0.0, 0.0], abs=3e-3)
    assert lies["back"][1] == pytest.approx(0.0, abs=3e-3)
    assert lies["back"][0] < -0.015


def test_a_figure_that_stays_where_it_was_made_turns_about_its_middle():
    points, doing, sculpture = made("as made\nfront: back")
    assert doing == "turned"
    assert sculpture.centre(points[-1]) == pytest.approx(sculpture.centre(points[0]), abs=3e-3)
    assert np.linalg.norm(np.diff(points, axis=0), axis=2).max() * 24.0 < 1.5


def test_a_figure_is_held_as_it_is_with_its_middle_at_the_origin():
    points, doing, _ = made("hold")
    assert doing == "held"
    assert points[-1].min(axis=0) + points[-1].max(axis=0) == pytest.approx(np.zeros(3), abs=2e-3)
    moved = points[-1] - points[0]
    assert np.abs(moved - moved.mean(axis=0)).max() < 2e-3


def test_a_figure_that_is_dropped_falls_and_lies_on_the_ground():
    points, doing, _ = made("drop\nheight: 0.3 m")
    low = points[:, :, 2].min(axis=1)
    assert doing == "fall"
    assert low.max() == pytest.approx(0.3, abs=5e-3)
    assert low[60:].min() > -7e-4
    assert low[-1] == pytest.approx(0.0, abs=5e-4)
    assert np.linalg.norm(points[-1] - points[-13], axis=1).max() < 2e-3


def test_a_figure_that_is_thrown_flies_ahead():
    points, doing, _ = made("throw\nspeed: 2")
    middle = points.mean(axis=1)
    fastest = -np.diff(middle[:, 0]).min() * 24.0
    assert doing == "fly"
    assert 1.4 < fastest < 2.0
    assert middle[-1, 0] < -0.3
    assert points[-1, :, 2].min() == pytest.approx(0.0, abs=1e-3)


def test_without_a_pose_a_figure_falls_only_where_its_recipe_asks_for_gravity():
    text = STOOL.replace("POSE", "as made").replace("hold: 0.5", "hold: 0.5, gravity: 9.81")
    frames = [frame.copy() for (frame,) in simulate_many([plan(Recipe.parse(text))], device="cpu").frames()]
    way = (frames[-13].points[0] - frames[-1].points[0]).mean(axis=0)
    assert frames[-1].doing == "fall"
    assert 0.15 < way[2] < 0.5
    assert abs(way[0]) < 0.05


def test_a_figure_weighs_its_rubber_and_the_gas_that_is_more_than_the_air_it_displaces():
    points, _, sculpture = made("hold")
    figure = rigid_figure(sculpture, points[-1])
    rubber = float(sculpture.scene.true_mass.numpy().sum())
    gas = MOLAR_MASS * float(sculpture.hands.amount.sum())
    air = OUTSIDE_DENSITY * float(sculpture.hands.volume.sum())
    assert figure.heavy == pytest.approx(rubber + gas - air, rel=1e-3)
    assert figure.inertial == pytest.approx(rubber + gas + 0.5 * air, rel=1e-3)
    assert gas / air == pytest.approx(1.08, abs=0.02)
    assert (points[-1].min(axis=0) < figure.centre).all()
    assert (points[-1].max(axis=0) > figure.centre).all()
    assert np.linalg.eigvalsh(figure.tensor).min() > 0.0
