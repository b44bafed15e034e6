"""Does a recipe make sense as a whole: names, order, balloons. No physics."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from balloon_usd.language.choices import one_of
from balloon_usd.operations.entries import steps_in, workbench_of
from balloon_usd.operations.workpiece import Workpiece

from .balloons import (
    FILLINGS,
    FLAT_ONLY,
    MESH_ONLY,
    ROUND_KEYS,
    ROUNDS,
    SIZE_CODES,
    Balloon,
    balloons_in,
    rounds_in,
)
from .facing import facing_complaints
from .held_words import held_complaints
from .mesh_words import mesh_complaints, meshes_in
from .model_words import model_complaints
from .pose_words import pose_complaints

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.language.problem import Complaint, Path
    from balloon_usd.operations.workbench import Workbench


class Meaning(NamedTuple):
    """What the plain data of a recipe means."""

    complaints: list[Complaint]
    """What does not make sense."""
    piece: Workpiece
    """What its steps make; whole where nothing is to complain of."""


def meaning_of(data: object) -> Meaning:
    """Interpret the plain data of a recipe, of whatever shape it is."""
    balloons, meshes, steps = balloons_in(data), meshes_in(data), steps_in(data)
    bench = workbench_of(balloons, steps, rounds_in(data))
    for balloon, entry in balloons.items():
        if balloon not in meshes:
            _check_filling(balloon, entry, bench)
    for step in steps:
        if bench.full:
            break
        if not meshes or step.whole:
            step.check(bench)
    piece = _blown_up(meshes, len(steps), bench) if meshes else bench.finished(len(steps))
    told = bench.complaints
    # Of what is not made rightly is not known what meets where.
    finished = [] if told else [*facing_complaints(data, piece), *held_complaints(data, piece)]
    return Meaning(
        [*told, *mesh_complaints(data), *model_complaints(data), *pose_complaints(data), *finished], piece
    )


def _blown_up(meshes: Sequence[str], steps: int, bench: Workbench) -> Workpiece:
    """Balloons from meshes: one bubble each, of its name, some in others."""
    piece = Workpiece(meshes)
    for name in meshes:
        piece.make(steps, name, name, last=True)
    bench.lay_in(piece)
    return piece


def _check_filling(balloon: str, entry: object, bench: Workbench) -> None:
    """Complain unless a balloon has a size, and is blown up in exactly one way."""
    if not isinstance(entry, dict):
        return
    path: Path = ("balloons", balloon)
    if "size" not in entry:
        bench.complain((*path, "size"), "is missing, expected the size of the balloon, such as 260")
    if str(entry.get("size")).upper() in ROUNDS:
        _check_round(path, entry, bench)
        return
    given = _told_once(path, entry, FILLINGS, bench)
    # Of a size that is none is told where it stands.
    if not given and str(entry.get("size")) in SIZE_CODES:
        kinds = "tail, inflated or filled, or capsule in model kosaka"
        bench.complain(path, f"does not say how far it is blown up, expected {kinds}")
    if "overblown" in entry and str(entry.get("size")) in SIZE_CODES:
        what = "makes no sense with a tube, whose short bubbles softened rubber does not hold"
        bench.complain((*path, "overblown"), f"{what}, expected a round balloon, or no such line")
    if given == ["capsule"]:
        for key in entry:
            if key in FLAT_ONLY:
                what = "makes no sense with capsule, which is no flat tube, expected no such entry"
                bench.complain((*path, key), what)


def _told_once(path: Path, entry: dict[str, object], ways: Sequence[str], bench: Workbench) -> list[str]:
    """Return the keys that say how far a balloon is blown up, and complain of all but the first."""
    given = [key for key in ways if key in entry]
    for extra in given[1:]:
        bench.complain((*path, extra), f"stands beside {given[0]}, expected exactly {one_of(ways)}")
    return given


def _check_round(path: Path, entry: dict[str, object], bench: Workbench) -> None:
    """Complain of what a round balloon does not have."""
    _told_once(path, entry, [key for key in FILLINGS if key in ROUND_KEYS], bench)
    for key in entry:
        # Of the others is told what they belong to.
        if key in Balloon.model_fields and key not in (*ROUND_KEYS, *MESH_ONLY):
            what = f"makes no sense with {entry['size']}, a round balloon, expected {one_of(ROUND_KEYS[1:])}"
            bench.complain((*path, key), what)
