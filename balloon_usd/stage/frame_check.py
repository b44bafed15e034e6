"""Frames are looked at before they are written: a bad one must not reach a file."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.stage.error import StageError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.stage.description import StageDescription, StageFrame


def check_frame(frame: StageFrame, description: StageDescription, expected: int | None) -> None:
    """Look at a frame's time code (None: any from 1 up), shapes and values.

    Raises:
        StageError: A time code is skipped, an array has the wrong shape or is not finite.
    """
    if frame.time_code != (expected or max(frame.time_code, 1)):
        raise StageError(f"frame {frame.time_code}: expected time code {expected or 'from 1 up'}")
    bubbles = len(description.bubble_names)
    count = len(description.meshes)
    if len(frame.points) != count or len(frame.stretch) != count:
        raise StageError(f"frame {frame.time_code}: {len(frame.points)} meshes, expected {count}")
    for mesh, points, stretch in zip(description.meshes, frame.points, frame.stretch, strict=True):
        _check(frame.time_code, f'points of "{mesh.name}"', points, (mesh.vertex_count, 3))
        _check(frame.time_code, f'stretch of "{mesh.name}"', stretch, (mesh.vertex_count,))
    _check(frame.time_code, "pressure", frame.pressure, (bubbles,))
    _check(frame.time_code, "volume", frame.volume, (bubbles,))


def _check(time_code: int, what: str, values: NDArray[np.float32], shape: tuple[int, ...]) -> None:
    if values.shape != shape or values.dtype != np.float32:
        found = f"{values.dtype} {values.shape}"
        raise StageError(f"frame {time_code}: {what} are {found}, expected float32 {shape}")
    if not np.isfinite(values).all():
        raise StageError(f"frame {time_code}: {what} are not finite")
