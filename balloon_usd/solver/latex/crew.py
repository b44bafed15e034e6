"""The crew: how many blocks of lanes work on each sculpture, and on which part of the flat state.

On the CPU it is one lane for each sculpture.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp

from balloon_usd.solver.kernels.lanes import WARP
from balloon_usd.solver.kernels.sculpture import advance_sculptures
from balloon_usd.solver.kernels.seen import ALONE

if TYPE_CHECKING:
    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.launch import Launcher


LANES = 128
"""Lanes of a block that shares its sculpture with others: few, so that each has much of its processor."""
BESIDE = 2
"""Blocks that one processor can run at a time."""


class Crew:
    """Advances all sculptures of a scene by several substeps in one launch."""

    def __init__(self, scene: LatexScene) -> None:
        """Share out a device; a GPU in as many blocks a sculpture as this fills, and as run at once."""
        self.scene = scene
        worlds = max(scene.worlds) + 1
        scene.zeros("chunk_share", len(scene.chunk_low), float)
        for name, starts in (
            ("balloon", np.arange(len(scene.bodies) + 1)),
            ("quad", scene.quad_start),
            ("vertex", scene.vertex_start),
            ("segment", scene.segment_start),
            ("joint", scene.joint_start),
        ):
            scene.put({f"world_{name}": scene.by_world(starts)})
        # While some look after the quads of a chunk, others see to the vertices that touch something.
        vertices, chunks = np.diff(scene.world_vertex.numpy()), np.diff(scene.world_chunk.numpy())
        need = int((vertices + WARP * chunks).max())
        device = wp.get_device(scene.device)
        at_once = device.sm_count // worlds if device.is_cuda else 1
        if need > LANES * at_once and device.is_cuda:
            at_once = BESIDE * device.sm_count // worlds
        self.blocks = max(1, min(-(-need // LANES), at_once))
        self.lanes = LANES if self.blocks > 1 else ALONE
        self._most_vertices = int(vertices.max())
        self._kernel = _quick_kernel(self.lanes) if device.is_cuda else advance_sculptures
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

    def _blocks_without_vertices(self) -> int:
        """Return how many blocks of a sculpture need not move any vertex but those of joints."""
        return max(0, self.blocks - -(-self._most_vertices // self.lanes))


@cache
def _quick_kernel(lanes: int) -> Any:
    """Return the kernel with approximate divisions and roots: half of the code of exact ones is for numbers
    that cannot occur, and a GPU has to fetch it all in every substep.

    `lanes`: of a block; those beside each other share the registers of a processor.
    """
    make = wp.kernel(module="unique", module_options={"fast_math": True}, launch_bounds=(lanes, BESIDE))
    return make(advance_sculptures.func)
