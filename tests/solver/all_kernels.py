"""All kernels of the solver by name."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

import warp as wp

from balloon_usd.solver import kernels


@cache
def all_kernels():
    found = {}
    for module in pkgutil.walk_packages(kernels.__path__, kernels.__name__ + "."):
        for thing in vars(importlib.import_module(module.name)).values():
            if isinstance(thing, wp.Kernel):
                found[thing.key] = thing
    return found
