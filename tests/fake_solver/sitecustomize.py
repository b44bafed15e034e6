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


def _kill_writers(module):
    """Let recipes kill the process that writes them."""
    from fake_solver import kill_if

    add = module.Sculpture.add

    def deadly(sculpture, frame):
        if frame.time_code == 3:
            kill_if("kill writer", sculpture._plan.recipe.name)
        return add(sculpture, frame)

    module.Sculpture.add = deadly


def _draw_anywhere(module):
    """Draw on the CPU whatever the device is called, and let recipes kill the process that draws them."""
    from dataclasses import replace

    from fake_solver import kill_if

    draw = module.draw

    def deadly(asked, order):
        kill_if("kill drawer", asked.name)
        return draw(replace(asked, device="cpu"), order)

    module.draw = deadly


def _pretend_gpus(module):
    """Let devices of FAKE_GPUS be there, each with so many multiprocessors and memory for many sculptures."""
    from fake_solver import FakeSolver

    from balloon_usd.batch.messages import Started

    gpus = tuple(filter(None, os.environ.get("FAKE_GPUS", "").split(",")))
    start = module.Simulator._started

    def started(simulator, name):
        device = gpus[0] if name in {"auto", "cuda", "all"} else name
        if device == "cpu":
            return start(simulator, name)
        if device not in gpus or FakeSolver.of_environment().has_lost(device):
            return Started(problem=f'there is no device "{device}", only cpu')
        simulator._device = device
        return Started(device, gpus, 4, 1 << 33)

    if gpus:
        module.Simulator._started = started


CHANGES = {
    "balloon_usd.batch.sculpture": _kill_writers,
    "balloon_usd.batch.sheet": _draw_anywhere,
    "balloon_usd.batch.simulator": _pretend_gpus,
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
