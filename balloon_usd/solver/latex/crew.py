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

if TYPE_CHECKING:
    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.launch import Launcher


LANES = 256
"""Most lanes of a block."""


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
        # Where there is room, more blocks of fewer lanes: each has more of its processor.
        self.lanes = LANES // 2 if need <= LANES * at_once else LANES
        self.blocks = max(1, min(-(-need // self.lanes), at_once))
        self._most_vertices = int(vertices.max())
        crowded = worlds > device.sm_count if device.is_cuda else False
        self._kernel = _quick_kernel(crowded=crowded) if device.is_cuda else advance_sculptures
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
def _quick_kernel(*, crowded: bool) -> Any:
    """Return the kernel with approximate divisions and roots: half of the code of exact ones is for numbers
    that cannot occur, and a GPU has to fetch it all in every substep.

    `crowded`: there are more sculptures than processors, so two at a time share the registers of each.
    """
    bounds = (LANES, 2) if crowded else None
    make = wp.kernel(module="unique", module_options={"fast_math": True}, launch_bounds=bounds)
    return make(advance_sculptures.func)
