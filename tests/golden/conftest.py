"""Golden stages: the recipes beside this file, simulated as they are now and as they were."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from balloon_usd import Recipe, plan_recipe
from balloon_usd.golden import perform

if TYPE_CHECKING:
    from collections.abc import Callable

RECIPES = Path(__file__).parent


def simulate_into(folder: Path, name: str) -> Path:
    """Simulate a recipe on the CPU and return the file of its stage."""
    return perform(plan_recipe(Recipe.load(RECIPES / f"{name}.yaml")), folder)


@pytest.fixture
def performed(tmp_path: Path) -> Callable[[str], Path]:
    """Simulate a recipe into an empty folder."""
    return lambda name: simulate_into(tmp_path, name)


@pytest.fixture(scope="session")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """The stage of a recipe as it is simulated now, once a session. Only to be read."""
    folder = tmp_path_factory.mktemp("fresh")

    def find(name: str) -> Path:
        file = folder / name / f"{name}.usda"
        return file if file.exists() else simulate_into(folder, name)

    return find
