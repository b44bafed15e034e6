"""Figures that nobody chose run to their end, and hold."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.plan import plan
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.simulation import simulate_many
from tests.crowd.trees import tree

SEEDS = range(30)
SHORT = 4
"""A seed whose figure is made in a few seconds."""


def test_a_seed_gives_one_tree():
    texts = [tree(seed) for seed in SEEDS]
    assert texts == [tree(seed) for seed in SEEDS]
    assert len(set(texts)) == len(texts)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_random_tree_can_be_planned(seed):
    planned = plan(Recipe.parse(tree(seed)))
    assert len(planned.bubbles) >= 3
    assert planned.frame_count > 0


@pytest.mark.parametrize(
    "seed", [pytest.param(seed, marks=[] if seed == SHORT else pytest.mark.long) for seed in SEEDS]
)
def test_a_random_tree_runs_to_its_end_with_its_joints(seed):
    planned = plan(Recipe.parse(tree(seed)))
    simulation = simulate_many([planned], detail="draft", device="cpu")
    quality, last = QualityWatch(planned, simulation.meshes[0]), None
    for (frame,) in simulation.frames():
        assert isinstance(frame, Frame), frame
        quality.add(frame)
        last = frame
    assert last is not None
    assert np.isfinite(np.concatenate(last.points)).all()
    assert quality.data()["joints"]["lost"] == []
