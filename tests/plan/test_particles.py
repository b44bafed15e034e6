"""Where the air particles are before the simulation."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from balloon_usd.balloon.capsule_mesh import EXPERIMENT_RADIUS
from balloon_usd.plan import plan
from balloon_usd.plan.blown import blown_shape
from balloon_usd.plan.particles import experiment_spacing, start_particles
from balloon_usd.recipe import Recipe

RECIPES = sorted((Path(__file__).parents[2] / "recipes" / "kosaka").glob("*.yaml"))
SIZES = (160, 260, 321, 350, 360, 646)


def strip_of(size: int, filling: str):
    balloons = f"balloons: {{main: {{size: {size}, {filling}}}}}\n"
    rest = "steps: [{wait: 1}]\nphysics: {model: kosaka}\n"
    return plan(Recipe.parse(f"format: 1\nname: air\nunits: cm\n{balloons}{rest}")).strips["main"]


def wall_distance(strip, air):
    """Distance of every particle from the wall, measured to many points of the meridian, m."""
    shape = blown_shape(strip)
    angles = np.linspace(0.0, math.pi, 400)
    arc = np.stack([-np.cos(angles), np.sin(angles)], axis=1) * shape.wide
    start, end = arc[:200] + [shape.wide, 0.0], arc[200:] + [shape.end - shape.wide, 0.0]
    x = np.linspace(start[-1, 0], end[0, 0], 1000)
    wall = np.concatenate([start, np.stack([x, np.full(1000, shape.wide)], axis=1), end])
    places = np.unique(np.stack([air[:, 0], np.hypot(air[:, 1], air[:, 2])], axis=1).round(7), axis=0)
    return np.linalg.norm(places[:, None] - wall[None], axis=2).min(axis=1)


def nearest(air):
    """Distance of every particle from its nearest neighbour, m."""
    apart = np.linalg.norm(air[:, None] - air[None], axis=2)
    np.fill_diagonal(apart, np.inf)
    return apart.min(axis=1)


@pytest.fixture(scope="module")
def experiment():
    strip = strip_of(260, "capsule: 20")
    return strip, start_particles(strip)


@pytest.fixture(scope="module")
def whole():
    strip = strip_of(260, "tail: 10")
    return strip, start_particles(strip)


def test_the_experiment_has_800_particles_in_40_by_4_by_5(experiment):
    _, air = experiment
    assert len(air) == 800
    assert [len(np.unique(air[:, k].round(9))) for k in range(3)] == [40, 4, 5]


def test_they_are_four_millimetres_apart_for_the_radius_of_the_experiment(experiment):
    strip, air = experiment
    scale = strip.inflated_radius / EXPERIMENT_RADIUS
    for k in range(3):
        assert np.diff(np.unique(air[:, k].round(9))) == pytest.approx(0.004 * scale)


def test_they_begin_inside_the_capsule_around_its_middle(experiment):
    strip, air = experiment
    assert air.mean(axis=0) == pytest.approx([0.1, 0.0, 0.0], abs=1e-12)
    room = blown_shape(strip).radius_at(air[:, 0]) - np.hypot(air[:, 1], air[:, 2])
    assert room.min() > 0.01
    assert wall_distance(strip, air).min() > 0.01


def test_a_longer_capsule_has_a_longer_block():
    air = start_particles(strip_of(260, "capsule: 28"))
    assert [len(np.unique(air[:, k].round(9))) for k in range(3)] == [56, 4, 5]


def test_the_spacing_once_spread_is_that_of_800_in_the_capsule_and_grows_with_the_balloon():
    volume = math.pi * 0.0255**2 * (0.2 - 2.0 * 0.0255 + 4.0 / 3.0 * 0.0255)
    assert experiment_spacing(0.0255) == pytest.approx((volume / 800) ** (1 / 3))
    assert experiment_spacing(0.051) == pytest.approx(2.0 * experiment_spacing(0.0255))


@pytest.mark.parametrize("filling", ["tail: 10", "tail: 0", "inflated: 45", "inflated: 10"])
def test_a_whole_260_is_as_dense_as_the_experiment_once_spread(filling):
    strip = strip_of(260, filling)
    shape, air = blown_shape(strip), start_particles(strip)
    x = np.linspace(0.0, shape.end, 10001)
    volume = np.trapezoid(math.pi * shape.radius_at(x) ** 2, x)
    wanted = volume / experiment_spacing(shape.wide) ** 3
    assert len(air) == pytest.approx(wanted, rel=0.05)


def test_it_is_as_dense_at_its_ends_as_in_its_middle(whole):
    strip, air = whole
    shape = blown_shape(strip)
    inside = air[(air[:, 0] > shape.wide) & (air[:, 0] < shape.end - shape.wide)]
    count, _ = np.histogram(inside[:, 0], 8)
    assert count == pytest.approx(np.full(8, count.mean()), rel=0.1)


def test_it_is_as_dense_on_all_sides(whole):
    _, air = whole
    assert air[:, 1:].mean(axis=0) == pytest.approx([0.0, 0.0], abs=1e-9)
    assert np.std(air[:, 1]) == pytest.approx(np.std(air[:, 2]), rel=1e-6)


@pytest.mark.parametrize("size", SIZES)
def test_none_is_within_half_a_spacing_of_the_wall(size):
    strip = strip_of(size, "inflated: 45")
    air = start_particles(strip)
    assert wall_distance(strip, air).min() > 0.5 * nearest(air).min()
    assert np.all((air[:, 0] > 0.0) & (air[:, 0] < blown_shape(strip).end))


def test_neighbours_are_about_as_far_apart_everywhere(whole):
    strip, air = whole
    spacing = experiment_spacing(strip.inflated_radius)
    apart = nearest(air[:1000])
    assert apart.min() > 0.85 * spacing
    assert apart.max() < spacing


@pytest.mark.parametrize("path", RECIPES, ids=lambda path: path.stem)
def test_every_bubble_of_the_shipped_recipes_has_air_at_the_start(path):
    for strip in plan(Recipe.load(path)).strips.values():
        shape, air = blown_shape(strip), start_particles(strip)
        starts = [shape.place_of(np.array([bubble.rest_start]))[0] for bubble in strip.bubbles]
        count, _ = np.histogram(air[:, 0], [*starts, shape.end])
        assert count.min() > 20


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("filling", ["tail: 5", "inflated: 3", "capsule: 40"])
def test_every_size_has_air(size, filling):
    air = start_particles(strip_of(size, filling))
    assert len(air) > 0
    assert np.isfinite(air).all()


def test_balloons_of_one_shape_have_as_many_particles_whatever_their_size():
    sizes = ("size: 160", "size: 160, radius: 8.96 mm")
    narrow, wide = (
        start_particles(plan(Recipe.parse(text)).strips["main"])
        for text in (
            f"format: 1\nname: air\nunits: cm\nballoons: {{main: {{{size}, capsule: {length}}}}}\n"
            "steps: [{wait: 1}]\nphysics: {model: kosaka}\n"
            for size, length in zip(sizes, (20, 80), strict=True)
        )
    )
    assert len(narrow) == len(wide)
    assert wide == pytest.approx(4.0 * narrow)


@settings(max_examples=40, deadline=None)
@given(st.sampled_from(SIZES), st.integers(4, 50), st.floats(0.006, 0.1))
def test_a_spacing_of_ones_own_always_gives_air_of_that_density(size, inflated, spacing):
    strip = strip_of(size, f"inflated: {inflated}" if inflated < 40 else f"capsule: {inflated}")
    shape, air = blown_shape(strip), start_particles(strip, spacing)
    assert len(air) >= 1
    if shape.end > 4.0 * shape.wide and shape.wide > 2.0 * spacing:
        volume = math.pi * shape.wide**2 * (shape.end - 2.0 / 3.0 * shape.wide)
        assert len(air) == pytest.approx(volume / spacing**3, rel=0.1)
