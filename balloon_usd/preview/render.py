"""Pictures of meshes that are given as arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.preview.raycast import Raycaster
from balloon_usd.preview.surface import SmoothSurface

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from balloon_usd.preview.camera import View
    from balloon_usd.preview.shot import Picture


def render_mesh(
    points: npt.ArrayLike,
    quads: npt.ArrayLike,
    colors: npt.ArrayLike,
    view: View = "three-quarter",
    size: tuple[int, int] = (480, 320),
    *,
    device: str = "auto",
) -> Picture:
    """Draw one mesh and return its picture (height, width, 3).

    Args:
        points: (V, 3) m, z up.
        quads: (Q, 4) vertex numbers, counter-clockwise seen from outside.
        colors: linear rgb, (3,) or (Q, 3).
        view: side, three-quarter, front-quarter, front or top.
        size: width and height (pixels).
        device: cpu, cuda:N, or auto for the first CUDA device and else the CPU.
    """
    return render_meshes([(points, quads, colors)], view, size, device=device)


def render_meshes(
    meshes: Sequence[tuple[npt.ArrayLike, npt.ArrayLike, npt.ArrayLike]],
    view: View = "three-quarter",
    size: tuple[int, int] = (480, 320),
    *,
    device: str = "auto",
) -> Picture:
    """Draw several meshes in one picture: (points, quads, colors) each, as in `render_mesh`."""
    surfaces = [quad_surface(quads) for _, quads, _ in meshes]
    caster = Raycaster(surfaces, [colors for _, _, colors in meshes], device=device)
    cages = [np.asarray(points, dtype=np.float32) for points, _, _ in meshes]
    return caster.shoot(cages, view, size).picture


def quad_surface(quads: npt.ArrayLike) -> SmoothSurface:
    """Prepare a cage of quads (Q, 4)."""
    corners = np.asarray(quads, dtype=np.int64)
    return SmoothSurface(np.full(len(corners), 4), corners.ravel())
