"""The search for walls that face each other, shared by all models."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.kernels.device.search_lanes import SEARCH_LANES
from balloon_usd.solver.kernels.device.warp_reduce import WARP
from balloon_usd.solver.kernels.physics.facing_walls import find_own_walls, find_walls, order_hits
from balloon_usd.solver.kernels.physics.surface import GROUP, chunk_surface, group_chunks, ring_radii

if TYPE_CHECKING:
    from balloon_usd.solver.launch import Launcher


class WallSearch:
    """Lists, for every vertex, the walls that it may touch until the next search."""

    def __init__(self, launcher: Launcher) -> None:
        self._launcher = launcher
        launcher.values["touch"] = launcher.scene.touch
        self._groups = -(-len(launcher.scene.x) * launcher.lanes(SEARCH_LANES) // launcher.lanes(WARP))
        # One block size for all: each size is a separate compilation.
        launcher.launch(find_own_walls, len(launcher.scene.x), lanes=WARP)
        self._grouped = launcher.lanes(WARP) == 1
        """Whether groups of chunks are tested first: a warp of a GPU tests 32 chunks at once."""
        launcher.load(chunk_surface, ring_radii, find_walls, order_hits, lanes=WARP)

    def measure_quads(self) -> None:
        """Measure the quads where they are."""
        chunks = len(self._launcher.scene.chunk_low)
        self._launcher.share_out(chunk_surface, chunks, lanes=WARP)
        if self._grouped:
            self._launcher.launch(group_chunks, -(-chunks // GROUP), lanes=WARP)

    def find(self) -> None:
        """Find the walls that face each other, once the quads are measured."""
        s, launcher = self._launcher.scene, self._launcher
        launcher.launch_tiled(ring_radii, len(s.ring_first), lanes=WARP)
        launcher.share_out(find_walls, self._groups, lanes=WARP)
        launcher.share_out(order_hits, len(s.quads), lanes=WARP, tiled=False)
