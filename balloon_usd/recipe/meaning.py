"""Does a recipe make sense as a whole: names, order, balloons. No physics."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.language.choices import one_of
from balloon_usd.operations.entries import steps_in, workpiece_of

from .balloons import FILLINGS, FLAT_ONLY, balloons_in
from .mesh_words import mesh_complaints, meshes_in
from .model_words import model_complaints

if TYPE_CHECKING:
    from balloon_usd.language.problem import Complaint, Path
    from balloon_usd.operations.workpiece import Workpiece


def meaning_complaints(data: object) -> list[Complaint]:
    """List what does not make sense in the plain data of a recipe, of whatever shape it is."""
    balloons, meshes, steps = balloons_in(data), meshes_in(data), steps_in(data)
    piece = workpiece_of(balloons, steps)
    for balloon, entry in balloons.items():
        if balloon not in meshes:
            _check_filling(balloon, entry, piece)
    for step in () if meshes else steps:
        if piece.full:
            break
        step.check(piece)
    return [*piece.complaints, *mesh_complaints(data), *model_complaints(data)]


def _check_filling(balloon: str, entry: object, piece: Workpiece) -> None:
    """Complain unless a balloon has a size, and is blown up in exactly one way."""
    if not isinstance(entry, dict):
        return
    path: Path = ("balloons", balloon)
    if "size" not in entry:
        piece.complain((*path, "size"), "is missing, expected the size of the balloon, such as 260")
    given = [key for key in FILLINGS if key in entry]
    if not given:
        piece.complain(path, f"does not say how far it is blown up, expected {one_of(FILLINGS)}")
    for extra in given[1:]:
        what = f"stands beside {given[0]}, expected exactly {one_of(FILLINGS)}"
        piece.complain((*path, extra), what)
    if given == ["capsule"]:
        for key in entry:
            if key in FLAT_ONLY:
                what = "makes no sense with capsule, which is no flat tube, expected no such entry"
                piece.complain((*path, key), what)
