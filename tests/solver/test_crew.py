"""The crew of a GPU does in one launch what the kernels do one after the other."""

from __future__ import annotations

import numpy as np
import pytest
import warp as wp

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.latex.crew import Crew, chunks_of
from balloon_usd.solver.simulation import simulate_many

HEAD = """
format: 1
name: head
units: cm
balloons:
  main: {size: 260, length: 14, tail: 6, color: red}
steps:
  - bubbles: {nose: 3, left_ear: 4, right_ear: 4}
  - lock: [left_ear, right_ear]
    point: up
  - push: {bubble: nose, depth: 0.3}
    seconds: 0.3
  - rest: tail
physics: {hold: 0.1}
"""
CUDA = [device.alias for device in wp.get_cuda_devices()]
"""GPUs of this machine."""
LIKE = 1e-3
"""Farthest that a vertex may be from where the other way puts it, m, in the end."""


def head():
    return plan(Recipe.parse(HEAD))


def performed(device, *, crew, copies=1, blocks=None):
    """The last frame of a head made with or without a crew."""
    simulation = simulate_many([head()] * copies, device=device)
    stepper = simulation.model.stepper
    stepper._crew = Crew(simulation.model.scene) if crew else None
    if blocks:
        stepper._crew.blocks = blocks
    *_, last = simulation.frames()
    return last[0]


def test_segments_are_cut_into_chunks_that_do_not_cross_their_borders():
    quads, first = chunks_of(np.array([0, 40, 110], np.int32), np.array([40, 110, 120], np.int32))
    assert quads.tolist() == [0, 32, 40, 72, 104, 110, 120]
    assert first.tolist() == [0, 2, 5, 6]


def test_a_crew_of_one_lane_makes_the_same_head():
    alone, by_kernels = performed("cpu", crew=True), performed("cpu", crew=False)
    assert alone.points[0] == pytest.approx(by_kernels.points[0], abs=LIKE)
    assert alone.volume == pytest.approx(by_kernels.volume, rel=1e-3)


@pytest.mark.parametrize("device", CUDA)
def test_a_crew_makes_the_same_head_as_the_kernels_one_by_one(device):
    together, by_kernels = performed(device, crew=True), performed(device, crew=False)
    assert together.points[0] == pytest.approx(by_kernels.points[0], abs=LIKE)
    assert together.volume == pytest.approx(by_kernels.volume, rel=1e-3)


@pytest.mark.parametrize("device", CUDA)
def test_the_size_of_a_crew_changes_no_bit(device):
    one, many = performed(device, crew=True, blocks=1), performed(device, crew=True)
    batch = performed(device, crew=True, copies=3)
    assert one.points[0].tobytes() == many.points[0].tobytes() == batch.points[0].tobytes()
