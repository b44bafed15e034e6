"""The crew: how many blocks of lanes work on each sculpture, and on which part of the flat state.

On the CPU it is one lane for each sculpture.
"""

from __future__ import annotations

from functools import cache
from types import FunctionType
from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp

from balloon_usd.solver.kernels.home import FORCE_BYTES, NEAR, PLACE_BYTES
from balloon_usd.solver.kernels.lanes import WARP
from balloon_usd.solver.kernels.sculpture import advance_sculptures
from balloon_usd.solver.kernels.seen import ALONE

if TYPE_CHECKING:
    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.launch import Launcher


LANES = 128
"""Lanes of a block that shares its sculpture with others: few, so that each has much of its processor."""
WARPS_OWN = 4096
"""Bytes of that memory that Warp needs for itself."""
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
        quads = np.diff(scene.world_quad.numpy())
        if self.blocks <= BESIDE and 2 * (PLACE_BYTES * vertices + FORCE_BYTES * quads).max() <= _room(
            device
        ):
            self.blocks, self.lanes = 1, NEAR
        self._most_vertices = int(vertices.max())
        self._kernel = _quick_kernel(self.lanes, _room(device)) if device.is_cuda else advance_sculptures
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


def _room(device: wp.Device) -> int:
    """Return how many bytes a block may have inside a processor of a GPU; on the CPU 0."""
    return int(device.max_shared_memory_per_block) - WARPS_OWN if device.is_cuda else 0


@cache
def _quick_kernel(lanes: int, room: int) -> Any:
    """Return the kernel with approximate divisions and roots: half of the code of exact ones is for numbers
    that cannot occur, and a GPU has to fetch it all in every substep.

    `lanes`: of a block; those beside each other share the registers of a processor. `room`: bytes inside a
    processor that a block takes where its sculpture is at home.
    """
    beside = 1 if lanes == NEAR else BESIDE
    make = wp.kernel(module="unique", module_options={"fast_math": True}, launch_bounds=(lanes, beside))
    body = advance_sculptures.func
    if lanes == NEAR:
        # The same kernel, in which one name means another function.
        body = FunctionType(body.__code__, body.__globals__ | {"take_room": _room_taker(room)}, body.__name__)
        body.__annotations__ = advance_sculptures.func.__annotations__
    return make(body)


def _room_taker(room: int) -> Any:
    """Return the function that takes so many bytes inside a processor."""
    numbers = room // 4

    @wp.func
    def take_room() -> None:
        """Take room for a sculpture."""
        wp.tile_zeros(shape=wp.static(numbers), dtype=float, storage="shared")

    return take_room
