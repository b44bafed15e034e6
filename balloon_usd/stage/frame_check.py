"""Frames are looked at before they are written: a bad one must not reach a file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.stage.error import StageError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.stage.description import StageDescription, StageFrame


def check_frame(frame: StageFrame, description: StageDescription, expected: int | None) -> None:
    """Look at a frame's time code (None: any from 1 up), shapes and values.

    Raises:
        StageError: A time code is skipped, an array has the wrong shape or is not finite, a particle
            is in a bubble that there is not.
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
    if description.airs:
        _check_air(frame, description)


def _check_air(frame: StageFrame, description: StageDescription) -> None:
    """Look at the particles of a frame."""
    count, bubbles = len(description.airs), len(description.bubble_names)
    if len(frame.air) != count or len(frame.cluster) != count:
        found = f"particles of {len(frame.air)} and clusters of {len(frame.cluster)} balloons"
        raise StageError(f"frame {frame.time_code}: {found}, expected {count}")
    for air, points, cluster in zip(description.airs, frame.air, frame.cluster, strict=True):
        _check(frame.time_code, f'particles of "{air.name}"', points, (air.count, 3))
        _check(frame.time_code, f'clusters of "{air.name}"', cluster, (air.count,), np.int32)
        if cluster.min() < 0 or cluster.max() >= bubbles:
            wrong = cluster[(cluster < 0) | (cluster >= bubbles)][0]
            text = f'a particle of "{air.name}" is in bubble {wrong}, expected 0 to {bubbles - 1}'
            raise StageError(f"frame {frame.time_code}: {text}")


def _check(
    time_code: int,
    what: str,
    values: NDArray[Any],
    shape: tuple[int, ...],
    kind: type[np.float32 | np.int32] = np.float32,
) -> None:
    if values.shape != shape or values.dtype != kind:
        found = f"{values.dtype} {values.shape}"
        raise StageError(f"frame {time_code}: {what} are {found}, expected {kind.__name__} {shape}")
    if not np.isfinite(values).all():
        raise StageError(f"frame {time_code}: {what} are not finite")
