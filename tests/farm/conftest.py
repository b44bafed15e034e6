"""Recipes in folders, and the command line as a user types it."""

from __future__ import annotations

import pytest
from click.testing import CliRunner

from balloon_usd.cli import main

RECIPE = """\
format: 1
name: {name}
units: cm
fps: 8
balloons:
  main: {{size: 260, length: 9.2, color: blue, tail: 3}}
steps:
  - bubbles: {{nose: 4}}
  - rest: tail
physics: {{hold: {hold}}}
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty folder in which commands are typed."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def write_recipe(folder):
    def write(file, name=None, hold=0.5):
        path = folder / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(RECIPE.format(name=name or path.stem, hold=hold))
        return path

    return write


@pytest.fixture
def cli(folder):
    def type_command(*words):
        return CliRunner().invoke(main, [str(word) for word in words], prog_name="balloon-usd")

    return type_command
