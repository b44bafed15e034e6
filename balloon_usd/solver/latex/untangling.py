"""Walls that have gone through each other, led back a step a frame, and shown where none cross."""

from __future__ import annotations

from typing import TYPE_CHECKING

import warp as wp

from balloon_usd.solver.kernels.device.warp_reduce import WARP
from balloon_usd.solver.kernels.physics.piercing_walls import box_walls, find_ways_back
from balloon_usd.solver.kernels.physics.untangling import (
    begin_untangling,
    draw_back,
    end_untangling,
    go_back,
    lead_back_slowly,
    next_round,
)

if TYPE_CHECKING:
    from balloon_usd.solver.launch import Launcher

PARTS = 8
"""Warps of a GPU that look for what one chunk of quads pierces: one dog has too few chunks to fill it
(with the candidates of each quad kept as bits, 350 -> 41 us a frame of a dog on an H200).
"""


class Untangling:
    """Leads walls back that have gone through each other, whatever brought them there."""

    def __init__(self, launcher: Launcher) -> None:
        self._launcher = launcher
        self._parts = PARTS if launcher.lanes(WARP) > 1 else 1
        launcher.load(box_walls, find_ways_back, lanes=WARP)
        launcher.load(begin_untangling)

    def run(self) -> None:
        """Lead them a step back, and find where they are shown; a graph goes on by itself while any cross."""
        s, launch = self._launcher.scene, self._launcher.launch
        worlds = len(s.pierced_count)
        s.untangling.zero_()
        launch(begin_untangling, worlds)
        self._find(worlds)
        launch(lead_back_slowly, len(s.x))
        wp.capture_while(s.untangling, lambda: self._round(worlds))
        launch(end_untangling, len(s.x))

    def _round(self, worlds: int) -> None:
        """Show walls a step farther back, and look again."""
        vertices = len(self._launcher.scene.x)
        self._launcher.launch(draw_back, vertices)
        self._launcher.launch(go_back, vertices)
        self._find(worlds)

    def _find(self, worlds: int) -> None:
        """Find where walls cross, and whether another round is needed."""
        chunks = len(self._launcher.scene.box_low)
        self._launcher.launch_tiled(box_walls, chunks, lanes=WARP)
        self._launcher.launch_tiled(find_ways_back, self._parts * chunks, lanes=WARP, parts=self._parts)
        self._launcher.launch(next_round, worlds)
