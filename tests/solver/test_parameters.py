"""The rule that gives the thesis's model its constants, against plain integrals of the thesis's equations."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import pytest

from balloon_usd.recipe.kosaka import Kosaka
from balloon_usd.solver.kernels.kosaka.offset_regions import WIDER
from balloon_usd.solver.kosaka.parameters import (
    GRADED_AWAY,
    Parameters,
    parameters,
    pressure_of_push,
    wall_repulsion,
)
from tests.solver import kosaka_reference as thesis

RADIUS, WIDTH, DT = 0.0255, 0.005, 1.0 / 480.0
SET = {
    "swell": 0.07,
    "natural": 0.6,
    "ks": 123.0,
    "kd": 4.5,
    "alpha": 67.0,
    "beta": 8.9,
    "push": 10.1,
    "gamma": 0.0011,
    "re": 0.012,
    "air_offset": 0.013,
    "contact_offset": 0.0014,
    "leak_offset": 0.015,
    "spacing": 0.006,
    "drag": 1.7,
    "grading": 0.18,
    "calming": 19.0,
    "force_limit": 2021.0,
    "elongation_limit": 2.2,
}
"""A value for everything that a recipe can set."""


def rule(radius: float = RADIUS, width: float = WIDTH, dt: float = DT, **given: float) -> Parameters:
    return parameters(Kosaka(**given), radius, width, dt)


def middles(low: float, high: float, count: int) -> np.ndarray:
    return low + (high - low) * (np.arange(count) + 0.5) / count


def test_everything_that_a_recipe_can_set_is_tried():
    assert set(Kosaka.model_fields) == set(SET)


@pytest.mark.parametrize("name", SET)
def test_what_the_recipe_sets_is_kept(name):
    assert getattr(rule(**{name: SET[name]}), name) == SET[name]


@pytest.mark.parametrize("name", SET)
def test_nothing_but_what_follows_from_it_changes_with_a_setting(name):
    follows = {
        "alpha": {"beta"},
        "re": {"beta"},
        "spacing": {"beta"},
        "grading": {"beta"},
        "natural": {"elongation_limit"},
    }
    plain, changed = rule(), rule(**{name: SET[name]})
    different = {f.name for f in fields(Parameters) if getattr(plain, f.name) != getattr(changed, f.name)}
    assert different == {name} | follows.get(name, set())


def test_switching_off_what_the_thesis_does_not_have_is_kept():
    law = rule(grading=0.0, calming=0.0, drag=0.0)
    assert (law.grading, law.calming, law.drag) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("name", ["gamma", "re", "air_offset", "leak_offset", "spacing", "force_limit"])
def test_lengths_scale_with_the_radius(name):
    assert getattr(rule(radius=3.0 * RADIUS), name) == pytest.approx(3.0 * getattr(rule(), name))


def test_the_contact_region_is_as_thick_as_faces_are_wide():
    assert rule(width=2.0 * WIDTH).contact_offset == pytest.approx(2.0 * rule().contact_offset)
    assert rule(radius=2.0 * RADIUS).contact_offset == rule().contact_offset


@pytest.mark.parametrize(
    "name", ["swell", "natural", "ks", "kd", "alpha", "calming", "grading", "elongation_limit"]
)
def test_a_larger_balloon_is_as_stiff_and_as_damped_as_a_small_one(name):
    assert getattr(rule(radius=2.0 * RADIUS), name) == getattr(rule(), name)


@pytest.mark.parametrize(("name", "power"), [("ks", 2), ("alpha", 2), ("beta", 2), ("kd", 1), ("calming", 1)])
def test_stiffness_and_damping_follow_the_time_step(name, power):
    assert getattr(rule(dt=0.5 * DT), name) == pytest.approx(2.0**power * getattr(rule(), name))


def test_there_is_one_particle_in_the_volume_of_one():
    assert rule(spacing=0.004).density == pytest.approx(0.004**-3)


def test_the_repulsion_at_a_wall_is_that_of_all_air_behind_it():
    alpha, re, spacing, steps = 400.0, 0.01, 0.004, 60
    along, across = middles(0.0, re, steps), middles(-re, re, 2 * steps)
    air = np.stack(np.meshgrid(along, across, across, indexing="ij"), axis=-1).reshape(-1, 3)
    volume = (re / steps) ** 3
    total = thesis.repulsion(np.zeros(3), air, alpha, re).sum(axis=0) * volume / spacing**3
    assert -total[0] == pytest.approx(wall_repulsion(alpha, re, spacing), rel=1e-3)
    assert total[1:] == pytest.approx([0.0, 0.0], abs=1e-6 * abs(total[0]))


@pytest.mark.parametrize("depth", [0.0, 0.2, 0.5, 0.8])
def test_the_graded_push_is_what_air_behind_a_wall_lacks(depth):
    steps = 60
    beyond, across = middles(depth, 1.0, steps), middles(-1.0, 1.0, 2 * steps)
    missing = np.stack(np.meshgrid(beyond, across, across, indexing="ij"), axis=-1).reshape(-1, 3)
    volume = (1.0 - depth) / steps * (1.0 / steps) ** 2
    lack = -thesis.repulsion(np.zeros(3), missing, 1.0, 1.0)[:, 0].sum() * volume
    assert thesis.lacking(depth) == pytest.approx(lack / wall_repulsion(1.0, 1.0, 1.0), abs=2e-3)


def test_what_grading_takes_away_is_its_mean_over_the_region():
    kept = thesis.grading(middles(0.0, 1.0, 2000), 1.0, WIDER, 1.0)
    assert pytest.approx(1.0 - kept.mean(), abs=1e-6) == GRADED_AWAY


@pytest.mark.parametrize("grading", [0.0, 1.0])
def test_evenly_spread_air_presses_on_a_plane_wall_as_the_rule_says(grading):
    side, offset, cells = 0.005, 0.01, 2
    places = side * np.arange(cells + 1)
    x = np.stack(np.meshgrid(places, places, [0.0], indexing="ij"), axis=-1).reshape(-1, 3)
    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).reshape(-1)
    triangles = thesis.triangles_of(corner[:, None] + [0, cells + 1, cells + 2, 1])
    # Air goes on beside the faces round the middle, as far as their regions do.
    beyond = 2.0 * side
    across, deep = middles(-beyond, cells * side + beyond, 151), middles(-offset, 0.0, 10)
    air = np.stack(np.meshgrid(across, across, deep, indexing="ij"), axis=-1).reshape(-1, 3)
    normal, d, uvw = thesis.regions(triangles, x, air)
    beside = uvw.min(axis=2)
    push = np.where(beside > -WIDER, thesis.grading(-d / offset, beside, WIDER, grading), 0.0)
    pushes = thesis.pushes(triangles, thesis.angles_of(triangles, x), normal, push, uvw)
    spacing = ((cells * side + 2.0 * beyond) ** 2 * offset / len(air)) ** (1.0 / 3.0)
    law = replace(rule(), air_offset=offset, grading=grading, spacing=spacing)
    middle = pushes[len(x) // 2] / side**2
    assert middle == pytest.approx([0.0, 0.0, pressure_of_push(law)], rel=0.1, abs=0.01 * middle[2])
