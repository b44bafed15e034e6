"""A new stage in the list beside golden stages, below what stands there, with every comment kept."""

from __future__ import annotations

import os
from pathlib import Path

from balloon_usd.golden.error import GoldenError
from balloon_usd.golden.list_file import FILE_NAME, FORMAT, read_list
from balloon_usd.stage.error import StageError, writing
from balloon_usd.stage.workspace import Workspace


def enter(folder: Path, name: str, recipe: Path, frames: int | None) -> bool:
    """Enter a stage into the list of a folder, which is made if need be; return whether it is in it now.

    A list that does not end in its stages, with two blanks before each name, is left as it is.

    Args:
        folder: of the golden stages.
        name: of the stage.
        recipe: its recipe.
        frames: the first so many; None: all.

    Raises:
        GoldenError: the list is wrong, or cannot be written.
    """
    if name in read_list(folder):
        return True
    file = folder / FILE_NAME
    earlier = file.read_text(encoding="utf-8").rstrip("\n") if file.exists() else f"format: {FORMAT}\nstages:"
    lines = [earlier, f"  {name}:", f"    recipe: {Path(os.path.relpath(recipe, folder)).as_posix()}"]
    lines += [] if frames is None else [f"    frames: {frames}"]
    try:
        with Workspace(file) as work:
            built = work.built
            with writing(file):
                built.write_text("\n".join([*lines, ""]), encoding="utf-8")
            if not _holds(built, name):
                return False
            work.publish()
    except StageError as error:
        raise GoldenError(str(error)) from error
    return True


def _holds(file: Path, name: str) -> bool:
    """Whether a list that is not in its place yet can be read and has the stage."""
    try:
        return name in read_list(file.parent)
    except GoldenError:
        return False
