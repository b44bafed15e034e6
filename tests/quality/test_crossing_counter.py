"""Crossings are counted by Warp or by NumPy, with the same result."""

from __future__ import annotations

import numpy as np
import pytest
import warp as wp

from balloon_usd.balloon.detail import detail_named
from balloon_usd.plan import plan as plan_of
from balloon_usd.plan.meshing import meshes_of
from balloon_usd.quality.crossing_counter import FEW, CrossingCounter
from balloon_usd.quality.walls import walls_of
from balloon_usd.recipe import Recipe
from tests.quality.ears import EARS, points_of


def ears():
    """Walls of two ears, and points of theirs."""
    plan = plan_of(Recipe.parse(EARS, file="ears.yaml"))
    meshes = meshes_of(plan, detail_named("draft"))
    return walls_of(plan, meshes), points_of(plan, meshes)


@pytest.fixture(scope="module")
def crumpled():
    """Walls of two ears, and points of theirs that lie in each other."""
    walls, points = ears()
    chance = np.random.default_rng(3)
    return walls, points + chance.uniform(-4e-3, 4e-3, points.shape).astype(np.float32)


@pytest.mark.parametrize("has_cpu_backend", [True, False], ids=["Warp", "no backend for CPUs"])
def test_many_frames_are_counted_as_one_is_with_and_without_a_backend_for_cpus(
    crumpled, has_cpu_backend, monkeypatch
):
    walls, points = crumpled
    one = CrossingCounter(walls, 1).count([points])
    monkeypatch.setattr(wp, "is_cpu_available", lambda: has_cpu_backend)
    many = CrossingCounter(walls, FEW + 1)
    assert many.count([points]) == one
    assert (many._search is None) != has_cpu_backend
    assert one.count > 100


@pytest.mark.parametrize(
    "vertex",
    [
        pytest.param(0, id="before the first neck"),
        pytest.param(-1, id="beyond the last", marks=pytest.mark.long),
    ],
)
def test_what_is_left_of_a_cut_end_lies_in_the_neck_and_what_hangs_there_does_not(vertex):
    walls, points = ears()
    ends = (side for side in walls.sides if range(len(points))[vertex] in side.vertices)
    cut = min(ends, key=lambda side: len(side.vertices))
    kept = np.setdiff1d(np.arange(len(points)), np.concatenate([cut.vertices, cut.ring]))
    ring = points[cut.ring]
    middle = ring.mean(axis=0)
    across = np.random.default_rng(1).uniform(-0.5, 0.5, (len(cut.vertices), 3))
    points[kept] += 1.0
    points[cut.vertices] = middle + across * np.linalg.norm(ring - middle, axis=1).max()
    found = CrossingCounter(walls, 1).count([points])
    assert found.count == 0
    assert found.in_necks > 100
    points[cut.vertices[-1]] += 0.1
    assert CrossingCounter(walls, 1).count([points]).count > 100
