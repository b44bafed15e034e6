"""Launch shape of the persistent kernel: how many blocks of how many threads advance each sculpture. All of
them advance by a substep in the same time, so a larger one gets more blocks.

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
    from numpy.typing import NDArray

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
        """Share out a device; a GPU in as many blocks as fill it and are resident at once."""
        self.scene = scene
        device = wp.get_device(scene.device)
        self._hosted = not device.is_cuda
        self._tiles, self.lanes, self._kernel = max(scene.worlds) + 1, 1, advance_sculptures
        if device.is_cuda:
            blocks, self.lanes, resident = self._shape(device)
            self.share_out(blocks)
            around = int(scene.joint_around.numpy().max())
            self._kernel = kernel_variant(
                self.lanes,
                shared=bool((blocks > 1).any()),
                resident_bytes=shared_memory_bytes(device) if resident else 0,
                cores=any(body.packs for body in scene.bodies),
                fingers=scene.settings.fingers,
                joint_lanes=HALF_WARP if around <= HALF_WARP else WARP,
            )

    def share_out(self, blocks: NDArray[np.int64]) -> None:
        """Give each sculpture so many blocks of a GPU: (sculptures,), all resident at once."""
        starts = np.concatenate([[0], np.cumsum(blocks)])
        self._tiles = int(starts[-1])
        self.scene.world_block.assign(starts.astype(np.int32))

    def advance(
        self, launcher: Launcher, substeps: int, begin: int, end: int, *, contact: bool, fingers: bool
    ) -> None:
        """Advance from one substep of a frame of so many to another."""
        launch = Launch()
        if self._hosted:
            launch.team, launch.member = launcher.threads, launcher.thread
            launch.yield_processor = wp.uint64(yield_processor())
        else:
            self.scene.barrier_counts.zero_()
        launch.substeps, launch.begin, launch.end = substeps, begin, end
        launch.walls, launch.pressing = int(contact), int(fingers)
        launch.dt = self.scene.settings.dt
        launch.frame_seconds = launch.dt * substeps
        launcher.launch_each(self._kernel, self._tiles, lanes=self.lanes, launch=launch)

    def _shape(self, device: wp.Device) -> tuple[NDArray[np.int64], int, bool]:
        """Return how many blocks of a GPU each sculpture gets, of how many threads, and whether all are
        resident in shared memory.
        """
        vertices, quads, chunks = (
            np.diff(self.scene.arrays[f"world_{name}"].numpy()) for name in ("vertex", "quad", "chunk")
        )
        # One warp for each chunk of quads, and one lane for each vertex for contact.
        need = vertices + WARP * chunks
        most = BLOCKS_PER_SM * device.sm_count
        size = 2 * int((VERTEX_BYTES * vertices + QUAD_BYTES * quads).max())
        alike = min(-(-int(need.max()) // LANES), most // len(need))
        if alike <= BLOCKS_PER_SM and size <= shared_memory_bytes(device):
            return np.ones_like(need), RESIDENT_LANES, True
        blocks = shares(need, device.sm_count)
        if (need > LANES * blocks).any():
            blocks = shares(need, most)
        return blocks, LANES if (blocks > 1).any() else SINGLE_BLOCK_LANES, False


def shares(need: NDArray[np.int64], blocks: int) -> NDArray[np.int64]:
    """Return how many blocks each sculpture gets of so many, (sculptures,): one at least, no more than it has
    work for, and such that the most that a block has to do is as little as possible.

    `need`: threads for which each sculpture has work, (sculptures,).
    """
    least, most = LANES, max(LANES, int(need.max()))
    while least < most:
        middle = (least + most) // 2
        if int((-(-need // middle)).sum()) <= blocks:
            most = middle
        else:
            least = middle + 1
    return -(-need // least)
