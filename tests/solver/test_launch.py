"""Launching: what is compiled, and when."""

from __future__ import annotations

import inspect
import subprocess
import sys

import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.launch import LAUNCH_BLOCK, Launcher
from balloon_usd.solver.simulation import simulate_many

PRESSED = """
format: 1
name: head
units: cm
balloons:
  main: {{size: 260, length: 14, tail: 6}}
steps:
  - bubbles: {{nose: 3, left_ear: 4, right_ear: 4}}
  - lock: [left_ear, right_ear]
    point: up
  - press: {{bubble: nose, depth: 0.3}}
    seconds: 0.3
  - rest: tail
physics: {{model: {model}, hold: 0.1}}
"""


@pytest.fixture
def used(monkeypatch):
    """Modules of kernels that were loaded or launched, each with its lanes."""
    found = set()
    load, launch, launch_tiled = Launcher.load, Launcher._launch, Launcher._launch_tiled

    def spied_load(self, *kernels, lanes=LAUNCH_BLOCK):
        found.update((kernel.module.name, lanes) for kernel in kernels)
        load(self, *kernels, lanes=lanes)

    def spied__launch(self, kernel, dim, lanes, changing):
        found.add((kernel.module.name, lanes))
        launch(self, kernel, dim, lanes, changing)

    def spied__launch_tiled(self, kernel, blocks, lanes, changing):
        found.add((kernel.module.name, lanes))
        launch_tiled(self, kernel, blocks, lanes, changing)

    for spied in (spied_load, spied__launch, spied__launch_tiled):
        monkeypatch.setattr(Launcher, spied.__name__.removeprefix("spied_"), spied)
    return found


@pytest.mark.parametrize("model", ["latex", "kosaka"])
def test_no_kernel_is_compiled_after_the_first_frame(model, used):
    frames = simulate_many([plan(Recipe.parse(PRESSED.format(model=model)))], device="cpu").frames()
    for _ in range(2):
        next(frames)
    early = set(used)
    assert all(found is not None for (found,) in frames)
    assert used == early


def test_nothing_that_threads_replay_needs_the_memory_for_tiles_that_they_share(monkeypatch):
    recorded, captured = set(), Launcher._captured

    def spied_captured(self, key, record):
        def spied_record():
            with monkeypatch.context() as recording:
                for name in ("_launch", "_launch_tiled"):
                    real = getattr(Launcher, name)

                    def spied(self, kernel, *others, real=real, **more):
                        recorded.add(kernel)
                        real(self, kernel, *others, **more)

                    recording.setattr(Launcher, name, spied)
                record()

        return captured(self, key, spied_record)

    monkeypatch.setattr(Launcher, "_captured", spied_captured)
    frames = simulate_many([plan(Recipe.parse(PRESSED.format(model="latex")))], device="cpu").frames()
    assert all(found is not None for (found,) in frames)
    assert {"advance_sculptures", "find_walls", "wall_loads"} <= {kernel.key for kernel in recorded}
    assert not [kernel.key for kernel in recorded if "wp.tile" in inspect.getsource(kernel.func)]


@pytest.mark.parametrize(("model", "other"), [("latex", "kosaka"), ("kosaka", "latex")])
def test_a_model_is_made_without_the_other(model, other):
    code = f"""
import sys
from balloon_usd.solver.simulation import model_named
model_named({model!r})
print([name for name in sys.modules if name.startswith('balloon_usd.solver.{other}')])
"""
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == "[]"
