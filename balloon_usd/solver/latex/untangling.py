"""Walls that have gone through each other, led back a step a frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.solver.kernels.device.warp_reduce import WARP
from balloon_usd.solver.kernels.physics.untangling import find_ways_back, go_back

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
        launcher.load(find_ways_back, lanes=WARP)
        launcher.load(go_back)

    def step(self) -> None:
        """Lead them as far as they go in a frame, once the quads are measured."""
        s, parts = self._launcher.scene, self._parts
        self._launcher.launch_tiled(find_ways_back, parts * len(s.chunk_low), lanes=WARP, parts=parts)
        self._launcher.launch(go_back, len(s.x))
