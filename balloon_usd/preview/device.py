"""The device that draws, and arrays on it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp

from balloon_usd.preview.error import PreviewError

if TYPE_CHECKING:
    import numpy.typing as npt


def drawing_device(name: str) -> Any:
    """Return the Warp device of a name.

    Raises:
        PreviewError: there is no such device; the message lists those that there are.
    """
    try:
        return wp.get_device(None if name == "auto" else name)
    except ValueError as error:
        there = ", ".join(device.alias for device in wp.get_devices())
        raise PreviewError(f'there is no device "{name}", only {there}') from error


def vectors(rows: npt.ArrayLike) -> Any:
    """Copy rows (N, 3) to the current device."""
    return wp.array(np.ascontiguousarray(rows, dtype=np.float32), dtype=wp.vec3)


def opaque(count: int) -> Any:
    """Return metallic, opacity and shine of polished latex for so many triangles, on the current device."""
    return vectors(np.tile([0.0, 1.0, 1.0], (count, 1)))
