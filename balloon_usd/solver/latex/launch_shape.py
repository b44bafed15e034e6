"""The crew: how many blocks of lanes work on each sculpture, and on which part of the flat state.

On the CPU it is one lane for each sculpture.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import warp as wp

from balloon_usd.solver.kernels.device.coherent_load import ALONE
from balloon_usd.solver.kernels.device.shared_memory import FORCE_BYTES, NEAR, PLACE_BYTES
from balloon_usd.solver.kernels.device.warp_reduce import HALF, WARP
from balloon_usd.solver.kernels.physics.sculpture import advance_sculptures
from balloon_usd.solver.latex.kernel_variants import BESIDE, quick_kernel, room_inside

if TYPE_CHECKING:
    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.launch import Launcher


LANES = 160
"""Lanes of a block that shares its sculpture with others: few, so that each has much of its processor, and as
many as let the blocks of a figure in full detail have one each.
"""


class Crew:
    """Advances all sculptures of a scene by several substeps in one launch."""

    def __init__(self, scene: LatexScene) -> None:
        """Share out a device; a GPU in as many blocks a sculpture as this fills, and as run at once."""
        self.scene = scene
        worlds = max(scene.worlds) + 1
        scene.zeros("chunk_share", len(scene.chunk_low), float)
        for name, starts in (
            ("balloon", np.arange(len(scene.bodies) + 1)),
            ("segment", scene.segment_start),
            ("joint", scene.joint_start),
        ):
            scene.put({f"world_{name}": scene.by_world(starts)})
        self._most_vertices = int(np.diff(scene.world_vertex.numpy()).max())
        device = wp.get_device(scene.device)
        self.blocks, self.lanes = self._share_out(device) if device.is_cuda else (1, 1)
        self._kernel = advance_sculptures
        if device.is_cuda:
            cores = any(body.packs for body in scene.bodies)
            around = int(scene.joint_around.numpy().max())
            joint = HALF if around <= HALF else WARP
            self._kernel = quick_kernel(self.lanes, room_inside(device), cores=cores, joint=joint)
        scene.zeros("gates", worlds, int)

    def advance(
        self, launcher: Launcher, substeps: int, begin: int, end: int, *, contact: bool, fingers: bool
    ) -> None:
        """Advance from one substep of a frame of so many to another."""
        worlds = max(self.scene.worlds) + 1
        self.scene.gates.zero_()
        launcher.launch_tiled(
            self._kernel,
            worlds * self.blocks,
            lanes=self.lanes,
            crew=self.blocks,
            joint_blocks=self._blocks_without_vertices() or self.blocks,
            substeps=substeps,
            begin=begin,
            end=end,
            walls=int(contact),
            pressing=int(fingers),
        )

    def _share_out(self, device: wp.Device) -> tuple[int, int]:
        """Return how many blocks of how many lanes each sculpture gets of a GPU."""
        vertices, quads, chunks = (
            np.diff(self.scene.arrays[f"world_{name}"].numpy()) for name in ("vertex", "quad", "chunk")
        )
        # While some look after the quads of a chunk, others see to the vertices that touch something.
        need = int((vertices + WARP * chunks).max())
        at_once = device.sm_count // len(vertices)
        if need > LANES * at_once:
            at_once = BESIDE * device.sm_count // len(vertices)
        blocks = max(1, min(-(-need // LANES), at_once))
        size = 2 * int((PLACE_BYTES * vertices + FORCE_BYTES * quads).max())
        if blocks <= BESIDE and size <= room_inside(device):
            return 1, NEAR
        return blocks, LANES if blocks > 1 else ALONE

    def _blocks_without_vertices(self) -> int:
        """Return how many blocks of a sculpture need not move any vertex but those of joints."""
        return max(0, self.blocks - -(-self._most_vertices // self.lanes))
