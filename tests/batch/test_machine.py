from __future__ import annotations

import os

import pytest

from balloon_usd.batch.machine import Device, Machine
from balloon_usd.processes.cores import usable_cores

H100 = Device("cuda:0", 132, 80 << 30)
CPU = Device("cpu")


@pytest.mark.parametrize(
    ("recipes", "together"),
    [(1, 1), (64, 64), (95, 95), (96, 48), (128, 64), (129, 65), (256, 128), (300, 100), (1000, 125)],
)
def test_a_gpu_gets_batches_of_equal_size(recipes, together):
    assert H100.together(1000, recipes) == together


def test_no_batch_is_larger_than_the_memory_of_its_device():
    small = Device("cuda:0", 8, 2 << 30)
    assert small.together(10_000, 100) == int(0.4 * (2 << 30)) // (6000 * 10_000)
    assert small.together(10**9, 100) == 1
    assert small.together(0, 10) == 10


def test_a_cpu_simulates_one_sculpture_at_a_time():
    assert CPU.together(10, 1000) == 1


@pytest.mark.parametrize(("cores", "recipes", "writers"), [(1, 99, 1), (2, 99, 1), (4, 99, 1), (16, 1, 1)])
def test_there_is_one_writer_where_there_is_little_to_do(cores, recipes, writers):
    assert Machine(cores).writers(recipes) == writers


@pytest.mark.parametrize(
    ("cores", "recipes", "writers"), [(16, 8, 2), (16, 1000, 12), (256, 1000, 16), (8, 1000, 5)]
)
def test_writers_grow_with_cores_and_recipes(cores, recipes, writers):
    assert Machine(cores).writers(recipes) == writers


def test_a_gpu_has_two_simulators_and_a_cpu_one_a_core():
    machine = Machine(8)
    assert [machine.simulators(H100, batches) for batches in (0, 1, 2, 9)] == [1, 1, 2, 2]
    assert [machine.simulators(CPU, batches) for batches in (1, 5, 100)] == [1, 5, 8]


@pytest.mark.parametrize(
    ("cores", "recipes", "drawers"), [(1, 100, 1), (16, 100, 2), (64, 100, 2), (16, 5, 2), (16, 4, 1)]
)
def test_few_processes_hold_a_context_to_draw(cores, recipes, drawers):
    assert Machine(cores).drawers(recipes) == drawers


def test_more_draw_when_nothing_else_is_at_work_any_more():
    assert [Machine(cores).drawers(100, alone=True) for cores in (1, 4, 16, 64)] == [1, 3, 12, 12]
    assert Machine(16).drawers(9, alone=True) == 3


@pytest.mark.parametrize(
    ("devices", "writers"), [(("cuda",), 16), (("cuda:0", "cuda:1"), 24), (("all",), 24)]
)
def test_several_gpus_have_more_writers(devices, writers):
    assert Machine(32, devices).writers(1000) == writers


def test_only_auto_falls_back():
    assert [
        Machine(1, devices).may_fall_back for devices in (("auto",), ("cuda",), ("cuda:0", "cuda:1"))
    ] == [
        True,
        False,
        False,
    ]


def test_only_cores_that_this_process_may_use_are_counted():
    before = os.sched_getaffinity(0)
    try:
        os.sched_setaffinity(0, {min(before)})
        assert usable_cores() == 1
    finally:
        os.sched_setaffinity(0, before)


@pytest.mark.parametrize(("sculptures", "threads"), [(1, 8), (2, 4), (3, 2), (8, 1), (100, 1)])
def test_cores_that_no_other_sculpture_needs_share_one(sculptures, threads):
    assert Machine(8).threads(sculptures) == threads
