"""The search for walls that face each other, shared by all models."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import warp as wp

from balloon_usd.solver.kernels.contact import (
    find_walls,
    order_hits,
    quad_surface,
    ring_radii,
    vertex_surface,
)

if TYPE_CHECKING:
    from balloon_usd.solver.launch import Launcher

GRID_CELLS = 64
"""Cells of a hash grid along each axis."""


def hash_grid(device: str) -> Any:
    """Return an empty hash grid on a device."""
    return wp.HashGrid(GRID_CELLS, GRID_CELLS, GRID_CELLS, device=device)


class WallSearch:
    """Lists, for every vertex, the walls that it may touch until the next search."""

    def __init__(self, launcher: Launcher, reach: float) -> None:
        """Prepare a search; `reach`: cell size (m), the size of a face and the contact offset."""
        self._launcher = launcher
        self._reach = reach
        self._grid = hash_grid(launcher.scene.device)
        launcher.values["grid"] = self._grid.id
        launcher.values["touch"] = launcher.scene.touch

    def find(self, x: Any) -> None:
        """Find the walls that face each other at positions `x` (V,)."""
        s, launch = self._launcher.scene, self._launcher.launch
        self.sort_quads(x)
        launch(vertex_surface, len(s.x))
        launch(ring_radii, len(s.ring_first), x=x)
        s.hit_count.zero_()
        launch(find_walls, len(s.x), x=x)
        launch(order_hits, len(s.quads))

    def sort_quads(self, x: Any) -> None:
        """Enter the quads at positions `x` (V,) into the grid, which kernels call `grid`."""
        s = self._launcher.scene
        self._launcher.launch(quad_surface, len(s.quads), x=x)
        self._grid.build(s.quad_middle, self._reach, groups=s.quad_world)
