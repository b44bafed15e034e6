"""The search for walls that face each other, shared by all models."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.solver.kernels.contact import (
    find_walls,
    order_hits,
    quad_surface,
    ring_radii,
    vertex_surface,
)

if TYPE_CHECKING:
    from balloon_usd.solver.launch import Launcher
    from balloon_usd.solver.search_grid import SearchGrid


class WallSearch:
    """Lists, for every vertex, the walls that it may touch until the next search."""

    def __init__(self, launcher: Launcher, grid: SearchGrid) -> None:
        """Prepare a search in a grid."""
        self._launcher = launcher
        self._grid = grid
        launcher.values["grid"] = grid.id
        launcher.values["touch"] = launcher.scene.touch

    def sort_quads(self, x: Any) -> None:
        """Enter the quads at positions `x` (V,) into the grid."""
        s = self._launcher.scene
        self._launcher.launch(quad_surface, len(s.quads), x=x)
        self._grid.build(s.quad_middle, s.quad_world)

    def find(self, x: Any) -> None:
        """Find the walls that face each other at positions `x` (V,), once the quads are in the grid."""
        s, launch = self._launcher.scene, self._launcher.launch
        launch(vertex_surface, len(s.x))
        launch(ring_radii, len(s.ring_first), x=x)
        s.hit_count.zero_()
        launch(find_walls, len(s.x), x=x)
        launch(order_hits, len(s.quads))
