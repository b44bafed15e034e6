"""Launch shape of the persistent kernel: how many blocks of how many threads advance each sculpture.

On the CPU a block is a thread of the team that shares a sculpture.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import warp as wp

from balloon_usd.solver.kernels.device.shared_memory import QUAD_BYTES, VERTEX_BYTES
from balloon_usd.solver.kernels.device.warp_reduce import HALF_WARP, WARP
from balloon_usd.solver.kernels.physics.sculpture import advance_sculptures
from balloon_usd.solver.kernels.physics.work_sharing import Launch
from balloon_usd.solver.latex.kernel_variants import BLOCKS_PER_SM, kernel_variant, shared_memory_bytes
from balloon_usd.solver.team import yield_processor

if TYPE_CHECKING:
    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.launch import Launcher


LANES = 160
"""Threads of a block that shares its sculpture with others: few, so that each has much of its SM, and as many
as let the blocks of a figure in full detail have an SM each.
"""
SINGLE_BLOCK_LANES = 256
"""Threads of a block that has a sculpture for itself."""
RESIDENT_LANES = 512
"""Threads of a block whose sculpture is resident in shared memory."""


class SculptureLaunch:
    """Advances all sculptures of a scene by several substeps in one launch."""

    def __init__(self, scene: LatexScene) -> None:
        """Share out a device; a GPU in as many blocks a sculpture as fill it and are resident at once."""
        self.scene = scene
        self._most_vertices = int(np.diff(scene.world_vertex.numpy()).max())
        device = wp.get_device(scene.device)
        self.blocks, self.lanes, resident = self._shape(device) if device.is_cuda else (1, 1, False)
        self._hosted = not device.is_cuda
        self._kernel = advance_sculptures
        if device.is_cuda:
            around = int(scene.joint_around.numpy().max())
            self._kernel = kernel_variant(
                self.lanes,
                shared=self.blocks > 1,
                resident_bytes=shared_memory_bytes(device) if resident else 0,
                cores=any(body.packs for body in scene.bodies),
                fingers=scene.settings.fingers,
                joint_lanes=HALF_WARP if around <= HALF_WARP else WARP,
            )

    def advance(
        self, launcher: Launcher, substeps: int, begin: int, end: int, *, contact: bool, fingers: bool
    ) -> None:
        """Advance from one substep of a frame of so many to another."""
        worlds = max(self.scene.worlds) + 1
        launch = Launch()
        launch.sculpture_blocks = self.blocks
        tiles = worlds * self.blocks
        if self._hosted:
            launch.sculpture_blocks, launch.block, tiles = launcher.threads, launcher.thread, worlds
            launch.yield_processor = wp.uint64(yield_processor())
        else:
            self.scene.barrier_counts.zero_()
        launch.joint_blocks = self._blocks_without_vertices() or launch.sculpture_blocks
        launch.substeps, launch.begin, launch.end = substeps, begin, end
        launch.walls, launch.pressing = int(contact), int(fingers)
        launch.dt = self.scene.settings.dt
        launch.frame_seconds = launch.dt * substeps
        launcher.launch_each(self._kernel, tiles, lanes=self.lanes, launch=launch)

    def _shape(self, device: wp.Device) -> tuple[int, int, bool]:
        """Return how many blocks of how many threads each sculpture gets of a GPU, and whether it is resident
        in shared memory.
        """
        vertices, quads, chunks = (
            np.diff(self.scene.arrays[f"world_{name}"].numpy()) for name in ("vertex", "quad", "chunk")
        )
        # One warp for each chunk of quads, and one lane for each vertex for contact.
        need = int((vertices + WARP * chunks).max())
        at_once = device.sm_count // len(vertices)
        if need > LANES * at_once:
            at_once = BLOCKS_PER_SM * device.sm_count // len(vertices)
        blocks = max(1, min(-(-need // LANES), at_once))
        size = 2 * int((VERTEX_BYTES * vertices + QUAD_BYTES * quads).max())
        if blocks <= BLOCKS_PER_SM and size <= shared_memory_bytes(device):
            return 1, RESIDENT_LANES, True
        return blocks, LANES if blocks > 1 else SINGLE_BLOCK_LANES, False

    def _blocks_without_vertices(self) -> int:
        """Return how many blocks of a sculpture need not move any vertex but those of joints."""
        return max(0, self.blocks - -(-self._most_vertices // self.lanes))
