"""The launch shape of the persistent kernel: it changes no bit."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import warp as wp

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.flatten import chunks_of
from balloon_usd.solver.latex.kernel_variants import kernel_variant, shared_memory_bytes
from balloon_usd.solver.latex.launch_shape import RESIDENT_LANES, SINGLE_BLOCK_LANES, shares
from balloon_usd.solver.simulation import simulate_many

HEAD = """
format: 1
name: head
units: cm
balloons:
  main: {size: 260, length: 8, tail: 6, color: red}
steps:
  - inflate: main
    seconds: 0.5
  - bubbles: {nose: 3, left_ear: 4, right_ear: 4}
  - lock: [left_ear, right_ear]
    point: up
    seconds: 1
  - press: {bubble: nose, depth: 0.3}
    seconds: 0.3
  - rest: tail
physics: {hold: 0.1}
"""
GPUS = [device.alias for device in wp.get_cuda_devices()]
DEVICES = ["cpu", *GPUS]
"""Where simulations can run on this machine."""


def head(hold=0.1):
    return plan(Recipe.parse(HEAD.replace("hold: 0.1", f"hold: {hold}")))


def performed(device, *, copies=1, blocks=None, alone=None):
    """The points of the last frame of the first of some heads, made by so many blocks of a GPU each, or by a
    single one of so many threads.
    """
    simulation = simulate_many([head()] * copies, device=device)
    launch = simulation.model.stepper._sculptures
    if blocks and device != "cpu":
        launch.share_out(np.array(blocks))
    if alone:
        launch.share_out(np.ones(copies, int))
        launch.lanes = alone
        launch._kernel = kernel_on(wp.get_device(device), alone)
    *_, last = simulation.frames()
    return last[0].points[0].tobytes()


@cache
def whole(device, copies=1):
    """The same by default."""
    return performed(device, copies=copies)


def kernel_on(device, lanes):
    """The kernel for blocks of so many lanes."""
    return kernel_variant(
        lanes,
        shared=False,
        resident_bytes=shared_memory_bytes(device) if lanes == RESIDENT_LANES else 0,
        cores=False,
        fingers=True,
    )


def test_segments_are_cut_into_chunks_that_do_not_cross_their_borders():
    quads, first = chunks_of(np.array([0, 40, 110], np.int32), np.array([40, 110, 120], np.int32))
    assert quads.tolist() == [0, 32, 40, 72, 104, 110, 120]
    assert first.tolist() == [0, 2, 5, 6]


def test_larger_sculptures_get_more_blocks():
    assert shares(np.array([1600, 1600, 16000, 100]), 132).tolist() == [10, 10, 100, 1]
    assert shares(np.array([1600, 1600, 16000, 100]), 40).tolist() == [4, 4, 31, 1]
    assert shares(np.array([1600] * 60), 132).tolist() == [2] * 60
    assert shares(np.array([1600] * 200 + [9000]), 132).tolist() == [1] * 201


@pytest.mark.parametrize("device", DEVICES)
def test_neither_the_number_of_blocks_nor_other_sculptures_change_a_bit(device):
    assert whole(device) == performed(device, blocks=[1]) == whole(device, 3)
    assert whole(device) == performed(device, copies=2, blocks=[2, 5])


@pytest.mark.parametrize("device", DEVICES)
def test_what_is_over_leaves_its_blocks_to_the_others_and_changes_no_bit_of_them(device):
    simulation = simulate_many([head(), head(0.8)], device=device, threads=1)
    short, long = simulation.frame_counts
    *_, (over, last) = simulation.frames()
    assert long > short + 10
    assert over is None
    *_, (alone,) = simulate_many([head(0.8)], device=device).frames()
    assert last.points[0].tobytes() == alone.points[0].tobytes()
    begin, middle, end = simulation.model.scene.world_block.numpy().tolist()
    assert (begin == middle < end) or device == "cpu"


@pytest.mark.parametrize("device", GPUS)
@pytest.mark.parametrize("lanes", [SINGLE_BLOCK_LANES, RESIDENT_LANES])
def test_a_single_block_gives_the_same_bits_with_and_without_shared_memory(device, lanes):
    assert performed(device, alone=lanes) == whole(device)


@pytest.mark.parametrize("device", DEVICES)
def test_halves_that_take_turns_have_the_bits_of_a_whole(device, monkeypatch):
    expected = whole(device, 3)
    monkeypatch.setattr("balloon_usd.solver.simulation.MANY", 2)
    assert performed(device, copies=3) == expected
