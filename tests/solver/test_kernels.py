"""Every kernel says what it writes, and gives the same bits whatever the order of threads."""

from __future__ import annotations

import importlib
import pkgutil
from pathlib import Path

import pytest

from balloon_usd.solver import kernels
from tests.solver.all_kernels import all_kernels

ORDERLESS = (
    "any_watched",
    "crossed_count",
    "hit_last",
    "listed_count",
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
    for module in pkgutil.walk_packages(kernels.__path__, kernels.__name__ + "."):
        source = Path(importlib.import_module(module.name).__file__).read_text(encoding="utf-8")
        for line in source.splitlines():
            if "atomic_" in line:
                assert any(name in line for name in ORDERLESS), line
