"""A process uses no more cores than it may."""

from __future__ import annotations

import os

import pytest

from balloon_usd.processes import cores


@pytest.fixture
def container(tmp_path, monkeypatch):
    """A folder that tells what a container may use, of a machine of eight cores."""
    monkeypatch.setattr(cores, "CONTROL_GROUP", tmp_path)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: set(range(8)), raising=False)
    (tmp_path / "cpu").mkdir()
    return tmp_path


@pytest.mark.parametrize(
    ("limit", "usable"),
    [
        ("max 100000", 8),
        ("200000 100000", 2),
        ("150000 100000", 2),
        ("50000 100000", 1),
        ("1600000 100000", 8),
        ("nonsense", 8),
        ("", 8),
        ("100000 0", 8),
    ],
)
def test_the_processor_time_of_a_container_limits_the_cores(container, limit, usable):
    (container / "cpu.max").write_text(limit + "\n")
    assert cores.usable_cores() == usable


@pytest.mark.parametrize(("quota", "usable"), [(-1, 8), (300000, 3), (250000, 3)])
def test_so_it_does_in_older_control_groups(container, quota, usable):
    (container / "cpu" / "cpu.cfs_quota_us").write_text(f"{quota}\n")
    (container / "cpu" / "cpu.cfs_period_us").write_text("100000\n")
    assert cores.usable_cores() == usable


def test_without_a_limit_all_cores_are_used_that_the_process_is_bound_to(container):
    assert cores.usable_cores() == 8
