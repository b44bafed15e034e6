"""What goes with balloons from mesh files: they are blown up, and not twisted."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.language.choices import one_of
from balloon_usd.language.problem import Complaint, quoted
from balloon_usd.operations.entries import steps_in
from balloon_usd.operations.table import OPERATIONS

from .balloons import MESH_KEYS, MESH_ONLY, Balloon, balloons_in

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.language.problem import Path

PHYSICS = {
    "mass_scaling": "without it a mesh has no time step that is known to work",
}
"""Keys of the physics whose other values a mesh does not bear, and why."""
USUAL: dict[str, object] = {"mass_scaling": "selective"}
"""The values that it does."""


def meshes_in(data: object) -> list[str]:
    """Names of the balloons that come from a mesh file, in plain data of whatever shape it is."""
    return [name for name, entry in balloons_in(data).items() if isinstance(entry, dict) and "mesh" in entry]


def mesh_complaints(data: object) -> Iterator[Complaint]:
    """Yield what does not go with balloons from mesh files, and what goes with nothing else."""
    for name, entry in balloons_in(data).items():
        if isinstance(entry, dict):
            yield from _keys(("balloons", name), entry)
    meshes = meshes_in(data)
    if meshes and isinstance(data, dict):
        yield from _others(data, meshes)
        yield from _steps(data, meshes[0])
        physics = data.get("physics")
        yield from _physics(physics if isinstance(physics, dict) else {}, meshes)


def _keys(path: Path, entry: dict[str, object]) -> Iterator[Complaint]:
    for key in entry:
        if "mesh" not in entry and key in MESH_ONLY:
            yield Complaint((*path, key), "makes no sense without mesh, expected no such entry")
        if "mesh" in entry and key in Balloon.model_fields and key not in MESH_KEYS:
            what = f"makes no sense with mesh, expected {one_of(MESH_KEYS[1:])}"
            yield Complaint((*path, key), what)


def _others(data: object, meshes: list[str]) -> Iterator[Complaint]:
    for name in balloons_in(data):
        if name not in meshes:
            what = f"stands beside {quoted(meshes[0])}, which is a mesh"
            yield Complaint(("balloons", name), f"{what}, expected meshes only: make a recipe of each kind")


def _steps(data: object, mesh: str) -> Iterator[Complaint]:
    words = tuple(each.word for each in OPERATIONS if each.whole)
    for step in steps_in(data):
        if not step.whole or len(step.words) > 1:
            path = (*step.path, *step.words[:1])
            what = f"{quoted(mesh)} is a mesh, which is blown up and not twisted"
            yield Complaint(path, f"{what}, expected {one_of(words)}")


def _physics(physics: dict[str, object], meshes: list[str]) -> Iterator[Complaint]:
    for key, why in PHYSICS.items():
        if physics.get(key, USUAL[key]) != USUAL[key]:
            yield Complaint(("physics", key), f"{why}, expected {USUAL[key]}")
    if physics.get("model") == "kosaka":
        for name in meshes:
            what = "makes no sense with model kosaka, whose balloons are tubes and capsules"
            yield Complaint(("balloons", name, "mesh"), f"{what}, expected model: latex")
