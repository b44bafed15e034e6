"""Open a stage to be compared, or say in one line why it cannot be."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from balloon_usd.diff.error import DamagedStageError, DiffError
from balloon_usd.openusd import Sdf, Tf, Usd, UsdGeom
from balloon_usd.stage.on_disk import file_of, is_cut_package, special_files, why_not_named
from balloon_usd.stage.opening import said_by, streaming

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@contextmanager
def reading() -> Iterator[None]:
    """Open and read stages inside the block quietly, and without their files growing into memory.

    Raises:
        DamagedStageError: a part of a file turns out to be damaged when it is read.
    """
    try:
        with streaming():
            yield
    except Tf.ErrorException as error:
        raise DamagedStageError(f"a value cannot be read: {said_by(error)}".removesuffix(": ")) from error


def stage_file(path: Path) -> Path:
    """Return the file of a stage: itself, or NAME/NAME.usda of a folder NAME.

    Raises:
        DiffError: there is no such file.
    """
    if why := why_not_named(path):
        raise DiffError(why)
    try:
        file = file_of(path)
        if not file.is_file():
            raise DiffError(f"{file} is not a file")
    except (OSError, ValueError) as error:
        raise DiffError(f"{path} cannot be read: {getattr(error, 'strerror', None) or error}") from error
    return file


def open_stage(file: Path) -> Any:
    """Open a stage with all that it is composed of; call it inside `reading`.

    Raises:
        DiffError: it is unreadable, no USD file, not whole, or has nothing to compare.
    """
    try:
        with file.open("rb"):
            pass
        layer = Sdf.Layer.FindOrOpen(str(file))
        if layer is None:
            raise DiffError(f"{file} is not a USD file, or not a whole one")
        if is_cut_package(file):
            raise DiffError(f"{file} is not a whole package: its end is missing")
        for asset, by in special_files(layer):
            raise DiffError(f"{file} is not whole: {asset}, which {by} needs, is a pipe or a device")
        stage = Usd.Stage.Open(layer)
    except OSError as error:
        raise DiffError(f"{file} cannot be read: {error.strerror or error}") from error
    except Tf.ErrorException as error:
        text = f"{file} is not a USD file, or not a whole one: {said_by(error)}"
        raise DiffError(text.removesuffix(": ")) from error
    require_whole(stage, file)
    return stage


def require_whole(stage: Any, file: Path) -> None:
    """Refuse a stage that lacks a part, or has no prim or no frame.

    Raises:
        DiffError: with the first thing that it lacks.
    """
    for error in stage.GetCompositionErrors():
        raise DiffError(f"{file} is not whole: {' '.join(str(error).split())}")
    if not stage.GetPseudoRoot().GetAllChildren():
        raise DiffError(f"{file} has no prims")
    start, end = stage.GetStartTimeCode(), stage.GetEndTimeCode()
    if stage.HasAuthoredTimeCodeRange() and not start <= end:
        raise DiffError(f"{file} has no frames: it begins at {start:g} and ends at {end:g}")
    for prim in stage.Traverse():
        points = UsdGeom.PointBased(prim).GetPointsAttr() if prim.IsA(UsdGeom.PointBased) else None
        if points and points.IsAuthored() and not points.HasAuthoredValue():
            raise DiffError(f"{file} has no frames: {prim.GetPath()} has points without any sample")
