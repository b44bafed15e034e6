"""Every kernel says what it writes, and gives the same bits whatever the order of threads."""

from __future__ import annotations

import importlib
import pkgutil
from pathlib import Path

import pytest
import warp as wp

from balloon_usd.solver import kernels
from balloon_usd.solver.kernels.device import atomic
from tests.solver.all_kernels import all_kernels

ORDERLESS = (
    "any_watched",
    "crossed_count",
    "hit_last",
    "listed_count",
    "looked_count",
    "most_near",
    "pair_count",
    "pierced_count",
    "pressed_count",
    "pushed",
    "segment_shift",
    "tangled",
    "untangling",
    "way_back",
    "wp.atomic_max(fastest",
)
"""Counts, maxima, sums of integers and a chain that is sorted: they do not depend on who comes first, nor does
what is done with lists so counted.
"""


@pytest.mark.parametrize("name", sorted(all_kernels()))
def test_every_kernel_says_what_it_writes(name):
    assert all_kernels()[name].func.__doc__


def test_no_kernel_adds_floats_atomically():
    ours = [name for name, found in vars(atomic).items() if isinstance(found, wp.Function)]
    calls = ["wp.atomic_", *(f"{name}(" for name in ours)]
    for module in pkgutil.walk_packages(kernels.__path__, kernels.__name__ + "."):
        source = Path(importlib.import_module(module.name).__file__).read_text(encoding="utf-8")
        for line in source.splitlines():
            if any(call in line for call in calls) and not line.startswith("def "):
                assert any(name in line for name in ORDERLESS), line
