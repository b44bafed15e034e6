"""Figures that nobody chose run to their end, and hold."""

from __future__ import annotations

import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from tests.crowd.trees import tree
from tests.crowd.watched import crossings, watched

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
def test_a_random_tree_runs_to_its_end_with_its_joints_and_no_wall_in_a_wall(seed):
    quality = watched(Recipe.parse(tree(seed)))
    assert not crossings(quality)
    found = quality.data()
    assert found is not None
    assert found["joints"]["lost"] == []
    assert found["creep"]["verdict"] != "off"
