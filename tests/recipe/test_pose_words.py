"""Words that go with the pose of a finished figure."""

from __future__ import annotations

import pytest

from balloon_usd.language.problem import RecipeError
from balloon_usd.recipe import Recipe, RecipeBuilder
from balloon_usd.recipe.recipe import EARTH

SHORT = """
format: 1
name: short
units: cm
balloons: {main: {size: 260, tail: 20}}
steps:
  - bubbles: {a: 5, b: 5}
"""


@pytest.mark.parametrize(
    ("end", "gravity"),
    [
        ("", 0.0),
        ("pose: hold", 0.0),
        ("pose: hang", 0.0),
        ("pose: stand", EARTH),
        ("pose: drop", EARTH),
        ("pose: throw", EARTH),
        ("pose: drop\nphysics: {gravity: 1.62}", 1.62),
        ("pose: stand\nphysics: {gravity: 0}", 0.0),
        ("physics: {gravity: 3.7}", 3.7),
        ("pose: stand\nphysics: {model: kosaka}", 0.0),
    ],
)
def test_gravity_acts_in_poses_on_the_ground_if_the_recipe_does_not_say(end, gravity):
    assert Recipe.parse(SHORT + end).gravity == gravity


@pytest.mark.parametrize(
    ("end", "problem"),
    [
        ("height: 50", "height: goes with a figure that falls, expected pose: drop or throw"),
        ("pose: stand\nspeed: 2", "speed: goes with a figure that falls, expected pose: throw"),
        ("pose: drop\nspeed: 2", "speed: goes with a figure that falls, expected pose: throw"),
        (
            "pose: drop\nphysics: {gravity: 0}",
            "physics.gravity: is too little for a figure to fall in pose drop, expected at least 0.1, or no such line",
        ),
        (
            "pose: throw\nphysics: {model: kosaka}",
            "pose: makes no sense with model kosaka, whose figures have no true weight, expected one of as made, "
            "stand, hang, hold",
        ),
        (
            "height: 1\nphysics: {model: kosaka}",
            "height: goes with a figure that falls, expected no such line",
        ),
        (
            "pose: stand\nphysics: {model: kosaka, gravity: 0.3}",
            "physics.gravity: draws a figure of model kosaka through the ground, which only latex knows, "
            "expected 0, or no such line",
        ),
        (
            "pose: fall\nheight: 1",
            'pose: unknown pose "fall", expected one of as made, stand, hang, hold, drop, throw',
        ),
        (
            "pose: drop\nphysics: {gravity: false}",
            "physics.gravity: false is no number, expected 0 to 100 m/s2",
        ),
        (
            "pose: drop\nheight: 12 m",
            "height: 12 m is out of range, expected at least 0 and at most 10 m",
        ),
        (
            "pose: throw\nspeed: 40",
            "speed: 40 is out of range, expected 0 to 10 m/s, the nearest is 10",
        ),
        (
            "pose: drop\nphysics: {gravity: -9.81}",
            "physics.gravity: -9.81 is out of range, expected 0 to 100 m/s2, the nearest is 0",
        ),
    ],
)
def test_what_does_not_go_with_a_pose_is_refused(end, problem):
    with pytest.raises(RecipeError) as error:
        Recipe.parse(SHORT + end)
    (found,) = error.value.problems
    assert str(found).split(": ", 1)[1] == problem


def test_a_thrown_figure_reads_back_as_it_was_written():
    written = (
        RecipeBuilder("short", pose="throw", height=1.5, speed=4)
        .balloon("main", size=260, tail=0.2)
        .bubbles(a=0.05, b=0.05)
        .build()
    )
    assert (written.height, written.speed, written.gravity) == (1.5, 4.0, EARTH)
    assert "height: 150\nspeed: 4\n" in written.to_yaml()
    assert Recipe.parse(written.to_yaml()) == written
