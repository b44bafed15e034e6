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
        self._at_once = 0
        """Blocks of a GPU that run at once, where several may share a sculpture."""
        if device.is_cuda:
            self._need = self._counts("vertex") + WARP * self._counts("chunk")
            """Threads for which each has work, (sculptures,): one warp for each chunk of quads, and one lane
            for each vertex for contact.
            """
            self.lanes, resident, self._at_once = self._shape(device)
            self.share_out(shares(self._need, max(self._at_once, len(self._need))))
            around = int(scene.joint_around.numpy().max())
            self._kernel = kernel_variant(
                self.lanes,
                shared=self._at_once > 0,
                resident_bytes=shared_memory_bytes(device) if resident else 0,
                cores=any(body.packs for body in scene.bodies),
                fingers=scene.settings.fingers,
                joint_lanes=HALF_WARP if around <= HALF_WARP else WARP,
            )

    def share_out(self, blocks: NDArray[np.int64]) -> None:
        """Give each sculpture so many blocks of a GPU: (sculptures,), all resident at once."""
        starts = np.concatenate([[0], np.cumsum(blocks)])
        self._tiles = max(self._at_once, int(starts[-1]))
        self.scene.world_block.assign(starts.astype(np.int32))

    def leave(self, over: NDArray[np.bool_]) -> None:
        """Leave sculptures as they are that are over, (sculptures,); a GPU gives their blocks to the others.

        54 figures of 310 to 4943 frames: 101 s instead of 320 s on an H200.
        """
        if self._at_once and not over.all():
            blocks = np.zeros_like(self._need)
            blocks[~over] = shares(self._need[~over], self._at_once)
            self.share_out(blocks)

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

    def _counts(self, name: str) -> NDArray[np.int64]:
        """Return how many each sculpture has of something, (sculptures,)."""
        counts: NDArray[np.int64] = np.diff(self.scene.arrays[f"world_{name}"].numpy()).astype(np.int64)
        return counts

    def _shape(self, device: wp.Device) -> tuple[int, bool, int]:
        """Return of how many threads the blocks of a GPU are, whether all sculptures are resident in shared
        memory, and how many blocks they share out: 0 where each has one.
        """
        need, most = self._need, BLOCKS_PER_SM * device.sm_count
        size = 2 * int((VERTEX_BYTES * self._counts("vertex") + QUAD_BYTES * self._counts("quad")).max())
        alike = min(-(-int(need.max()) // LANES), most // len(need))
        if alike <= BLOCKS_PER_SM and size <= shared_memory_bytes(device):
            return RESIDENT_LANES, True, 0
        few = (need <= LANES * shares(need, device.sm_count)).all()
        at_once = device.sm_count if few else most
        if (shares(need, at_once) > 1).any():
            return LANES, False, at_once
        return SINGLE_BLOCK_LANES, False, 0


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
