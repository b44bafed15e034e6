"""Puts the fake solver into worker processes, whose start runs this where a test put its folder on the path."""

import errno
import importlib.abc
import importlib.util
import os
import pathlib
import sys


def _exchange_solver(module):
    from fake_solver import FakeSolver

    module.simulate_many = FakeSolver.of_environment()


def _shorten_plans(module):
    module.Plan.frame_count = property(lambda _: int(os.environ["FAKE_FRAMES"]))


def _fill_disk(_):
    """Let the disk be full for one file, named by a test."""
    replace = pathlib.Path.replace

    def full(path, target):
        if pathlib.Path(target).name == os.environ.get("FAKE_FULL_DISK"):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))
        return replace(path, target)

    pathlib.Path.replace = full


CHANGES = {
    "balloon_usd.batch.writer": _fill_disk,
    "balloon_usd.solver.simulation": _exchange_solver,
    "balloon_usd.plan.model": _shorten_plans,
}


class _Change(importlib.abc.MetaPathFinder):
    """Lets a module be loaded, and then changes it."""

    def find_spec(self, name, path=None, target=None):
        if name not in CHANGES:
            return None
        sys.meta_path.remove(self)
        spec = importlib.util.find_spec(name)
        sys.meta_path.insert(0, self)
        load = spec.loader.exec_module

        def exec_module(module):
            load(module)
            CHANGES[name](module)

        spec.loader.exec_module = exec_module
        return spec


if os.environ.get("FAKE_SOLVER"):
    sys.meta_path.insert(0, _Change())
