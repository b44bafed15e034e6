"""Recipes, a solver without physics, and the command line as a user types it."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

sys.path.insert(0, str(Path(__file__).parent))

from fake_solver import FakeSolver

from balloon_usd.cli import main

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
def solver(monkeypatch):
    """The solver of this test; set its `trouble` before running."""
    fake = FakeSolver()
    monkeypatch.setattr("balloon_usd.cli.perform.simulate_many", fake)
    monkeypatch.setattr("balloon_usd.solver.simulation.simulate_many", fake)
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
    """Everything that a folder holds, hidden files too."""

    def look(folder="out"):
        root = tmp_path / folder
        return sorted(str(path.relative_to(root)) for path in root.rglob("*") if path.is_file())

    return look
