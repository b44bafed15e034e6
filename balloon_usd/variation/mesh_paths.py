"""Mesh files of a recipe as they are found from the folder of its variations."""

from __future__ import annotations

import os
from pathlib import Path as File
from typing import TYPE_CHECKING

from balloon_usd.language.problem import escaped
from balloon_usd.variation.error import VariationError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.language.problem import Path

DEPTH = 3
"""Keys down to a mesh: balloons, name, mesh."""


def mesh_paths(data: object) -> Iterator[tuple[Path, str]]:
    """Yield the places of mesh files in the plain data of a recipe, and what stands there."""
    balloons = data.get("balloons") if isinstance(data, dict) else None
    for name, balloon in balloons.items() if isinstance(balloons, dict) else ():
        mesh = balloon.get("mesh") if isinstance(balloon, dict) else None
        if isinstance(mesh, str):
            yield ("balloons", name, "mesh"), mesh


def moved_value(path: Path, value: object, source: File, target: File) -> object:
    """Return a value of a recipe as it must stand in another folder: relative paths of mesh files differ.

    Args:
        path: where the value stands.
        value: plain data.
        source: folder from which the paths are found.
        target: folder from which they will be found.

    Raises:
        VariationError: no relative path leads there, as from one drive to another.
    """
    if path and path[0] != "balloons":
        return value
    if len(path) == DEPTH and path[-1] == "mesh" and isinstance(value, str):
        return _moved(value, source, target)
    if len(path) < DEPTH and isinstance(value, dict):
        return {key: moved_value((*path, key), entry, source, target) for key, entry in value.items()}
    return value


def _moved(mesh: str, source: File, target: File) -> str:
    if not mesh or File(mesh).is_absolute() or os.path.realpath(source) == os.path.realpath(target):
        return mesh
    file = source / mesh
    try:
        # The file keeps its own name where that is a link.
        moved = os.path.relpath(os.path.realpath(file.parent), os.path.realpath(target))
        path = File(moved, file.name).as_posix()
        path.encode("utf-8")
    except ValueError as error:
        shown = escaped(f"{mesh}: no relative path leads to it from {target}")
        raise VariationError(
            [f"{shown}, expected a folder on the same drive, with a name in UTF-8"]
        ) from error
    return path
