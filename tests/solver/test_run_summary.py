"""What a run tells of the gas of its bubbles, from frames that are made up."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from balloon_usd.balloon.detail import detail_named
from balloon_usd.plan import plan
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import LEAST_SLOWNESS, Frame
from balloon_usd.solver.run_summary import RunSummary
from tests.verification.setups import polygon_factor

TEXT = """
format: 1
name: gas
units: cm
balloons: {main: {size: 260, length: 14, tail: 6}}
steps: [bubbles: {one: 1.5, two: 4, three: 4}]
physics: {hold: 1%s}
"""


@pytest.fixture
def told():
    """What is told of a figure whose bubbles hold these shares of the planned gas."""

    def tell(*shares, rest=1.0, physics="", **changed):
        planned = plan(Recipe.parse(TEXT % physics))
        meshes = tuple(mesh_of(strip, detail_named("draft")) for strip in planned.strips.values())
        summary = RunSummary(planned, meshes)
        volume = np.array([bubble.volume for bubble in planned.bubbles]) * [*shares, rest]
        frame = Frame(
            time_code=planned.frame_count,
            points=tuple(mesh.points for mesh in meshes),
            stretch=tuple(np.ones(len(mesh.points), dtype=np.float32) for mesh in meshes),
            pressure=np.array([bubble.pressure or 0.0 for bubble in planned.bubbles], dtype=np.float32),
            volume=(volume * polygon_factor(meshes[0].around)).astype(np.float32),
            doing="hold",
        )
        summary.add(replace(frame, **changed))
        return summary.gas_off

    return tell


def test_gas_as_planned_is_not_told(told):
    assert told(1.0, 0.95, 1.05) == {}


def test_a_bubble_with_too_little_or_too_much_gas_is_told(told):
    assert told(0.05, 1.0, 1.2) == pytest.approx({"one": 0.05, "three": 1.2}, rel=1e-5)


def test_a_rest_that_found_no_gas_is_told(told):
    assert told(1.0, 1.0, 1.0, rest=0.2) == pytest.approx({"main_rest": 0.2}, rel=1e-5)


def test_bubbles_beside_a_twist_that_came_undone_are_not_told(told):
    assert told(0.05, 1.2, 1.2, undone=("two.end",)) == pytest.approx({"one": 0.05}, rel=1e-5)


def test_gas_that_leaks_on_purpose_is_not_told(told):
    assert told(0.5, 0.5, 0.5, physics=", leak: 6 h") == {}


def test_nothing_is_told_before_the_end(told):
    assert told(0.05, 0.05, 0.05, time_code=1) == {}


def test_springs_of_model_kosaka_have_no_gas_to_tell(told):
    assert told(0.05, 0.05, 0.05, physics=", model: kosaka") == {}


def test_the_highest_stretch_leaves_out_walls_that_are_led_but_not_those_that_others_press():
    planned = plan(Recipe.parse(TEXT % ""))
    mesh = mesh_of(next(iter(planned.strips.values())), detail_named("draft"))
    stretch = np.full(len(mesh.points), 5.0, dtype=np.float32)
    slowness = np.zeros(len(mesh.points), dtype=np.float32)
    stretch[[7, 8, 9]] = 6.0, 7.0, np.inf
    slowness[[7, 8, 9]] = LEAST_SLOWNESS, 0.1, 0.1
    bubbles = np.ones(len(planned.bubbles), dtype=np.float32)
    frame = Frame(1, (mesh.points,), (stretch,), bubbles, bubbles, "hold", slowness=(slowness,))
    summary = RunSummary(planned, (mesh,))
    summary.add(frame)
    assert summary.highest_stretch == pytest.approx(6.0)
