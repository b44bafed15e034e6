"""The soft shadow on the floor below a sculpture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import warp as wp

from balloon_usd.preview.camera import SMALLEST
from balloon_usd.preview.kernels.raycast import Floor, Scene, light_floor, soften_floor

if TYPE_CHECKING:
    from balloon_usd.preview.subdivide import Points

FLOOR_CELLS = 96
"""Cells along the longer side of the baked shadow."""
FLOOR_SPREAD = 0.45
"""Border of the baked shadow round the sculpture, as a share of its longer side."""


def bake_floor(points: Points, scene: Scene, height: float) -> Floor:
    """Bake the shadow of points (V, 3) on a floor at a height (m)."""
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    border = FLOOR_SPREAD * max(SMALLEST, *(float(side) for side in high - low))
    extent = high - low + 2.0 * border
    cell = float(max(extent)) / FLOOR_CELLS
    columns, rows = (int(n) + 1 for n in extent / cell)
    floor = Floor()
    floor.corner = wp.vec3(float(low[0]) - border, float(low[1]) - border, height)
    floor.cell = cell
    shade: Any = wp.empty((rows, columns), dtype=wp.vec3)
    floor.shade = shade
    sharp = wp.empty_like(floor.shade)
    wp.launch(light_floor, dim=sharp.shape, inputs=[scene, floor, sharp])
    wp.launch(soften_floor, dim=sharp.shape, inputs=[sharp, floor.shade])
    return floor
