"""Walls that are kept from going through each other, and led apart where they have all the same."""

from __future__ import annotations

from typing import TYPE_CHECKING

import warp as wp

from balloon_usd.solver.kernels.device.search_lanes import SEARCH_LANES
from balloon_usd.solver.kernels.device.warp_reduce import WARP
from balloon_usd.solver.kernels.physics.keeping_apart import (
    begin_keeping_apart,
    begin_move_rounds,
    begin_moves,
    begin_untangling,
    end_keeping_apart,
    go_on_watching,
    move_together,
)
from balloon_usd.solver.kernels.physics.momentum import measure_momentum, take_momentum
from balloon_usd.solver.kernels.physics.piercing_walls import box_walls, find_piercing_walls
from balloon_usd.solver.kernels.physics.untangling import (
    draw_back,
    end_round,
    end_untangling,
    next_round,
)

if TYPE_CHECKING:
    from balloon_usd.solver.launch import Launcher

PARTS = 4
"""Parts in which a GPU looks through what quads may pierce, each by warps of its own: one dog has too few
chunks to fill it. With 2 the crown of 54 bubbles takes 7 % longer; with 8, 256 dogs take a sixth longer.
"""
WARPS_PER_SM = 64
"""Warps that look for what pierces what, for each SM: twice as many as it runs at a time."""


class Untangling:
    """Keeps walls apart: at the end of every frame, and at every search where they would have crossed."""

    def __init__(self, launcher: Launcher, between_searches: float) -> None:
        """Get ready; `between_searches`: time between two searches for facing walls, s."""
        self._launcher = launcher
        self._between_searches = between_searches
        self._parts = launcher.lanes(PARTS)
        self._chunks = len(launcher.scene.box_low)
        self._groups = self._parts * launcher.lanes(SEARCH_LANES) * self._chunks
        device = wp.get_device(launcher.scene.device)
        if device.is_cuda:
            self._groups = min(self._groups, WARPS_PER_SM * device.sm_count)
        launcher.load(box_walls, find_piercing_walls, measure_momentum, lanes=WARP)
        launcher.load(begin_keeping_apart, draw_back, take_momentum)
        self.start()

    def start(self) -> None:
        """Let walls be apart where they are now."""
        s, launcher = self._launcher.scene, self._launcher
        launcher.copy(s.x_safe, s.x)
        launcher.fill(s.safe_seconds, launcher.values["frame_seconds"])

    def leave(self) -> None:
        """Let walls be wherever they are at the end of a frame."""
        s = self._launcher.scene
        self._launcher.zero(s.crossed, s.watched, s.slowness, s.reaction, s.any_watched)
        self.start()

    def watch(self) -> None:
        """Keep walls apart between two searches, in sculptures that are watched."""
        self._launcher.when(self._launcher.scene.any_watched, lambda: self._keep_apart(frame_ends=0))

    def end_frame(self) -> None:
        """Keep walls apart at the end of a frame."""
        self._keep_apart(frame_ends=1)

    def begin_frame(self) -> None:
        """Forget how far walls were led in the last frame, and which could not be kept apart."""
        s = self._launcher.scene
        self._launcher.zero(s.segment_shift, s.segment_jammed)

    def _keep_apart(self, *, frame_ends: int) -> None:
        """Let walls that would cross move as one, and lead apart those that still do; a graph goes on by
        itself while any cross.
        """
        s, launch = self._launcher.scene, self._launcher.launch
        vertices, worlds = len(s.x), len(s.pierced_count)
        launch(begin_keeping_apart, worlds, frame_ends=frame_ends)
        launch(begin_moves, vertices)
        self._find(together=1)
        launch(begin_move_rounds, worlds, frame_ends=frame_ends)
        self._launcher.loop(s.untangling, self._move_round)
        between = self._between_searches
        launch(end_keeping_apart, vertices, between_searches=between)
        launch(begin_untangling, worlds, frame_ends=frame_ends, between_searches=between)
        self._launcher.when(s.tangled, self._untangle)
        self._launcher.launch_tiled(measure_momentum, worlds, lanes=WARP)
        launch(take_momentum, vertices)
        launch(go_on_watching, worlds, frame_ends=frame_ends, between_searches=between)

    def _move_round(self) -> None:
        """Let walls that would cross move as one, in a round."""
        s, launch = self._launcher.scene, self._launcher.launch
        launch(move_together, len(s.x))
        launch(end_round, len(s.x))
        self._find(together=1)
        launch(next_round, len(s.pierced_count))

    def _untangle(self) -> None:
        """Lead walls apart that cross."""
        s, launch = self._launcher.scene, self._launcher.launch
        launch(begin_moves, len(s.x))
        self._launcher.fill(s.untangling, 1)
        self._launcher.loop(s.untangling, self._round)
        launch(end_untangling, len(s.x))

    def _round(self) -> None:
        """Lead walls that cross a step farther apart."""
        s, launch = self._launcher.scene, self._launcher.launch
        self._find(together=0)
        launch(next_round, len(s.pierced_count))
        launch(draw_back, len(s.x))
        launch(end_round, len(s.x))

    def _find(self, *, together: int) -> None:
        """Find where walls cross as they are kept apart."""
        self._launcher.share_out(box_walls, self._chunks, lanes=WARP)
        self._launcher.share_out(
            find_piercing_walls,
            self._groups,
            lanes=WARP,
            parts=self._parts,
            launched=self._groups,
            together=together,
        )
