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


@pytest.fixture(scope="module")
def crumpled():
    """Walls of two ears, and points of theirs that lie in each other."""
    plan = plan_of(Recipe.parse(EARS, file="ears.yaml"))
    meshes = meshes_of(plan, detail_named("draft"))
    points = points_of(plan, meshes)
    chance = np.random.default_rng(3)
    return walls_of(plan, meshes), points + chance.uniform(-4e-3, 4e-3, points.shape).astype(np.float32)


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
