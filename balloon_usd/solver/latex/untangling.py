"""Walls that have gone through each other, led back a step a frame, and shown where none cross."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import warp as wp

from balloon_usd.solver.kernels.device.warp_reduce import WARP
from balloon_usd.solver.kernels.physics.piercing_walls import box_walls, find_ways_back
from balloon_usd.solver.kernels.physics.untangling import (
    begin_rounds,
    begin_showing,
    begin_untangling,
    draw_back,
    end_showing,
    go_back,
    keep_ways,
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

    def lead(self) -> None:
        """Lead walls a step back that crossed at the end of the last frame."""
        self._launcher.launch(lead_back_slowly, len(self._launcher.scene.x))

    def show(self) -> None:
        """Find where walls are shown at the end of a frame; a graph goes on by itself while any cross."""
        s, launch = self._launcher.scene, self._launcher.launch
        vertices, worlds = len(s.x), len(s.pierced_count)
        s.segment_shift.zero_()
        wp.copy(s.x_shown, s.x)
        launch(begin_untangling, worlds)
        self._find(s.joint_leader)
        launch(keep_ways, vertices)
        launch(begin_rounds, worlds)
        launch(begin_showing, vertices)
        wp.capture_while(s.untangling, self._round)
        launch(end_showing, vertices)

    def _round(self) -> None:
        """Show walls that still cross a step farther back."""
        s, launch = self._launcher.scene, self._launcher.launch
        self._find(s.joint_meant)
        launch(next_round, len(s.pierced_count))
        launch(draw_back, len(s.x))
        launch(go_back, len(s.x))

    def _find(self, necks: Any) -> None:
        """Find where walls cross as they are shown; `necks`: neck of every joint, (joints,) on the device."""
        chunks = len(self._launcher.scene.box_low)
        self._launcher.launch_tiled(box_walls, chunks, lanes=WARP)
        groups, told = self._parts * chunks, {"parts": self._parts, "necks": necks}
        self._launcher.launch_tiled(find_ways_back, groups, lanes=WARP, **told)
