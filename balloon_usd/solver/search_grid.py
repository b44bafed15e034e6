"""The hash grid of a scene, built anew for every search.

Warp 1.19 keeps the descriptor that a grid's build copies to a CUDA device in one variable for all grids, and
a recorded graph reads that variable when it is replayed. So a scene has one grid, with one cell size, for all
that it searches; and a scene whose graph is replayed after another scene's grid was built first builds its
own once more.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import warp as wp

if TYPE_CHECKING:
    from balloon_usd.solver.scene import Scene

CELLS = 64
"""Cells along each axis; farther ones share theirs."""


class SearchGrid:
    """Finds points near a place, of one set of points at a time."""

    _latest: ClassVar[dict[str, SearchGrid]] = {}
    """The grid that was built last, by device."""

    def __init__(self, scene: Scene, cell: float, most_points: int) -> None:
        """Reserve memory for so many points; `cell`: size of a cell (m), about that of the searches."""
        self._device = scene.device
        self._cell = cell
        self._grouped = max(scene.worlds) > 0
        self._grid = wp.HashGrid(CELLS, CELLS, CELLS, device=scene.device)
        self._grid.reserve(most_points, with_groups=self._grouped)
        self._points, self._worlds = scene.quad_middle, scene.quad_world

    @property
    def id(self) -> int:
        """Handle of the grid for kernels."""
        return int(self._grid.id)

    def build(self, points: Any, worlds: Any) -> None:
        """Enter points (N,), m, of which only those of one world are found together: `worlds` (N,)."""
        # Without other worlds to keep apart it is built and searched faster.
        self._grid.build(points, self._cell, groups=worlds if self._grouped else None)
        self._latest[self._device] = self

    def claim(self) -> None:
        """Make this grid the one that graphs on the device build when they are replayed."""
        if self._latest.get(self._device) is not self:
            self.build(self._points, self._worlds)
