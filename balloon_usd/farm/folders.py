"""The folders of a job: where the recipes lie, and what a template can say of it."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from balloon_usd.plan import Plan

MOST_CHARACTERS = 1024
"""Of the default of a parameter in OpenJD."""


def recipe_folder(plans: Iterable[Plan]) -> Path:
    """Return the lowest folder, absolute, that holds all recipes and the mesh files that they name.

    Raises:
        ValueError: there is none, as on several drives.
    """
    files = [file for plan in plans for file in _files_of(plan)]
    return Path(os.path.commonpath([os.path.dirname(os.path.abspath(file)) for file in files]))  # noqa: PTH100, PTH120  # links stay as they are


def _files_of(plan: Plan) -> list[Path]:
    recipe = Path(plan.recipe.file)
    meshes = [balloon.mesh for balloon in plan.recipe.balloons.values() if balloon.mesh]
    return [recipe, *(recipe.parent / mesh for mesh in meshes)]


def default_below(folder: Path, template_folder: Path) -> str | None:
    """Return a folder as the default of a parameter of a job; None if it can be none.

    OpenJD takes only folders that lie below that of the template, seen from there.

    Args:
        folder: absolute.
        template_folder: where the template is written, absolute.
    """
    if not folder.is_relative_to(template_folder):
        return None
    default = folder.relative_to(template_folder).as_posix()
    return default if len(default) <= MOST_CHARACTERS else None
