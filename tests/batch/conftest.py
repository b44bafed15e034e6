from __future__ import annotations

import pytest

from tests.command_line import RECIPE, cli, left, solver, write_recipe

__all__ = ["cli", "left", "solver", "write_recipe"]


@pytest.fixture
def gpu(solver, monkeypatch):
    """A pretended GPU, so that batches have several recipes."""
    monkeypatch.setenv("FAKE_GPUS", "cuda:0")


def write_recipes_into(folder, names, text=RECIPE):
    """Write recipes of these names into a folder, and return it."""
    folder.mkdir(exist_ok=True)
    for name in names:
        (folder / f"{name}.yaml").write_text(text.format(name=name, fps=24))
    return folder


@pytest.fixture
def write_recipes(tmp_path):
    """Write small recipes of these names into a folder, and return it."""
    return lambda *names, folder="recipes": write_recipes_into(tmp_path / folder, names)
