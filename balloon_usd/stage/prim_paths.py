"""Where the prims of a sculpture stand."""

from __future__ import annotations

from typing import Any

from balloon_usd.openusd import Sdf


def root_path(name: str) -> Any:
    """Path of the sculpture's root prim."""
    return Sdf.Path.absoluteRootPath.AppendChild(name)


def class_path(name: str) -> Any:
    """Path of the class that the root inherits, so that a shot can change every copy at once."""
    return Sdf.Path(f"/__class__/{name}")


def parts_path(name: str) -> Any:
    """Path of the scope that holds the meshes and the air."""
    return Sdf.Path(f"/{name}/geo/render")


def part_path(name: str, part: str) -> Any:
    """Path of one balloon's mesh or air."""
    return parts_path(name).AppendChild(part)


def materials_path(name: str) -> Any:
    """Path of the scope that holds the materials."""
    return Sdf.Path(f"/{name}/mtl")
