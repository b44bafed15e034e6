"""Fixtures of runs: recipes, a solver without physics, and the command line as a user types it."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from balloon_usd.cli import main
from tests.fake_solver.fake_solver import FakeSolver

FAKE = Path(__file__).parent / "fake_solver"

RECIPE = """\
format: 1
name: {name}
title: A small snake
units: cm
fps: {fps}
balloons:
  main: {{size: 260, color: red, tail: 20}}
steps:
  - bubbles: {{nose: 8, middle: 10}}
  - rest: tail
"""


@pytest.fixture
def write_recipe(tmp_path):
    def write(name="snake", file=None, fps=24, text=None):
        path = tmp_path / (file or f"{name}.yaml")
        path.parent.mkdir(exist_ok=True)
        path.write_text(text or RECIPE.format(name=name, fps=fps))
        return path

    return write


@pytest.fixture
def solver(monkeypatch, tmp_path_factory):
    """The solver of this test, in this process and in workers; set its `trouble` before running."""
    return pretend_solver(monkeypatch, tmp_path_factory.mktemp("solver"))


def pretend_solver(patch, folder):
    """Let a solver without physics take the place of the real one until the patch is undone."""
    fake = FakeSolver(folder)
    patch.setenv("FAKE_SOLVER", str(folder))
    patch.setenv("FAKE_FRAMES", str(fake.frame_count))
    patch.setattr("sys.path", [str(FAKE), *sys.path])
    patch.setattr("balloon_usd.solver.simulation.simulate_many", fake)
    return fake


@pytest.fixture
def cli(tmp_path, monkeypatch):
    """Type a command in an empty folder."""
    monkeypatch.chdir(tmp_path)

    def type_command(*words):
        return CliRunner().invoke(main, [str(word) for word in words], prog_name="balloon-usd")

    return type_command


@pytest.fixture
def left(tmp_path):
    """Everything that a folder holds, hidden files too, but the journal of the batch."""

    def look(folder="out"):
        root = tmp_path / folder
        files = (str(path.relative_to(root)) for path in root.rglob("*") if path.is_file())
        return sorted(file for file in files if file != "batch.jsonl")

    return look
