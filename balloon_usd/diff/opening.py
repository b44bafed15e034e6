"""Open a stage to be compared, or say in one line why it cannot be."""

from __future__ import annotations

import os
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from pxr import Tf, Usd, UsdGeom, UsdUtils

from balloon_usd.diff.error import DiffError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

READ_IN_PARTS = "USDC_USE_PREAD"
"""Setting of OpenUSD: binary files are read part by part instead of mapped into memory as a whole."""


@contextmanager
def streaming() -> Iterator[None]:
    """Open and read stages inside the block without their files growing into memory, and without chatter.

    Raises:
        DiffError: a part of a file turns out to be damaged when it is read.
    """
    before = os.environ.get(READ_IN_PARTS)
    os.environ[READ_IN_PARTS] = "1"
    held = UsdUtils.CoalescingDiagnosticDelegate()
    try:
        yield
    except Tf.ErrorException as error:
        raise DiffError(f"a stage is damaged: {_reason(error)}") from error
    finally:
        held.TakeUncoalescedDiagnostics()
        if before is None:
            del os.environ[READ_IN_PARTS]
        else:
            os.environ[READ_IN_PARTS] = before


def stage_file(path: Path) -> Path:
    """Return the file of a stage: itself, or NAME/NAME.usda of a folder NAME.

    Raises:
        DiffError: there is no such file.
    """
    try:
        # The folder one stands in has a name only when it is resolved.
        folder = path if path.name not in {"", ".."} else path.resolve()
        file = folder / f"{folder.name}.usda" if path.is_dir() else path
        if not file.is_file():
            raise DiffError(f"{file} is not a file")
    except (OSError, ValueError) as error:
        raise DiffError(f"{path} cannot be read: {getattr(error, 'strerror', None) or error}") from error
    return file


def open_stage(path: Path) -> Any:
    """Open a stage with all that it is composed of; call it inside `streaming`.

    Raises:
        DiffError: it is missing, unreadable, no USD file, not whole, or has nothing to compare.
    """
    file = stage_file(path)
    try:
        with file.open("rb"):
            pass
        stage = Usd.Stage.Open(str(file))
    except OSError as error:
        raise DiffError(f"{file} cannot be read: {error.strerror or error}") from error
    except Tf.ErrorException as error:
        raise DiffError(f"{file} is not a USD file, or not a whole one: {_reason(error)}") from error
    require_whole(stage, file)
    return stage


def require_whole(stage: Any, file: Path) -> None:
    """Refuse a stage that lacks a part, or has no prim or no frame.

    Raises:
        DiffError: with the first thing that it lacks.
    """
    for error in stage.GetCompositionErrors():
        raise DiffError(f"{file} is not whole: {_one_line(str(error))}")
    if not stage.GetPseudoRoot().GetAllChildren():
        raise DiffError(f"{file} has no prims")
    start, end = stage.GetStartTimeCode(), stage.GetEndTimeCode()
    if stage.HasAuthoredTimeCodeRange() and not start <= end:
        raise DiffError(f"{file} has no frames: it begins at {start:g} and ends at {end:g}")
    for prim in stage.Traverse():
        points = UsdGeom.PointBased(prim).GetPointsAttr() if prim.IsA(UsdGeom.PointBased) else None
        if points and points.IsAuthored() and not points.HasAuthoredValue():
            raise DiffError(f"{file} has no frames: {prim.GetPath()} has points without any sample")


def _reason(error: Any) -> str:
    """First cause that USD gives, on one line."""
    return _one_line(str(error.args[0].commentary))


def _one_line(text: str) -> str:
    return " ".join(text.split())
