"""The persistent kernel on a GPU, in variants that differ in their compile-time constants."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from balloon_usd.solver.kernels.device.warp_reduce import WARP
from balloon_usd.solver.kernels.physics.sculpture import substep_kernel

if TYPE_CHECKING:
    import warp as wp

BLOCKS_PER_SM = 2
"""Occupancy: blocks that one SM runs at a time; of those with a sculpture in shared memory, one."""
RESERVED_BYTES = 4096
"""Bytes of a block's shared memory that Warp needs for itself."""


def shared_memory_bytes(device: wp.Device) -> int:
    """Return how many bytes of shared memory a block may use; on the CPU 0."""
    return int(device.max_shared_memory_per_block) - RESERVED_BYTES if device.is_cuda else 0


@cache
def kernel_variant(
    lanes: int, *, shared: bool, resident_bytes: int, cores: bool, fingers: bool, joint_lanes: int = WARP
) -> Any:
    """Return the kernel with approximate divisions and roots: half of the code of exact ones is for numbers
    that cannot occur, and a GPU has to fetch it all in every substep.

    `lanes`: threads of a block; blocks of one SM share its registers. The others: see `substep_kernel`.
    """
    return substep_kernel(
        shared=shared,
        cores=cores,
        fingers=fingers,
        joint_lanes=joint_lanes,
        resident_bytes=resident_bytes,
        module="unique",
        module_options={"fast_math": True},
        launch_bounds=(lanes, 1 if resident_bytes else BLOCKS_PER_SM),
    )
