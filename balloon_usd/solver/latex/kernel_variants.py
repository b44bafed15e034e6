"""The persistent kernel on a GPU, in variants that differ in their compile-time constants."""

from __future__ import annotations

from functools import cache
from types import FunctionType
from typing import Any

import warp as wp

from balloon_usd.solver.kernels.device.shared_memory import RESIDENT_LANES
from balloon_usd.solver.kernels.device.warp_reduce import HALF_WARP, WARP
from balloon_usd.solver.kernels.physics.sculpture import advance_sculptures

BLOCKS_PER_SM = 2
"""Occupancy: blocks that one SM runs at a time; of those with a sculpture in shared memory, one."""
RESERVED_BYTES = 4096
"""Bytes of a block's shared memory that Warp needs for itself."""


def shared_memory_bytes(device: wp.Device) -> int:
    """Return how many bytes of shared memory a block may use; on the CPU 0."""
    return int(device.max_shared_memory_per_block) - RESERVED_BYTES if device.is_cuda else 0


@cache
def kernel_variant(lanes: int, shared_bytes: int, *, cores: bool, joint: int = WARP) -> Any:
    """Return the kernel with approximate divisions and roots: half of the code of exact ones is for numbers
    that cannot occur, and a GPU has to fetch it all in every substep.

    `lanes`: threads of a block; blocks of one SM share its registers. `shared_bytes`: shared memory that a
    block reserves where its sculpture is resident. `cores`: whether any neck may pack. `joint`: lanes that
    move a joint, a warp or half of one.
    """
    blocks = 1 if lanes == RESIDENT_LANES else BLOCKS_PER_SM
    make = wp.kernel(module="unique", module_options={"fast_math": True}, launch_bounds=(lanes, blocks))
    others = {} if cores else {"cores_may_pack": _nothing_packs()}
    if joint < WARP:
        others["joint_lanes"] = _half_a_warp()
    if lanes == RESIDENT_LANES:
        others["reserve_shared_memory"] = _reservation(shared_bytes)
    # Rebind globals of the same code, so that these names resolve to specialised functions.
    code = advance_sculptures.func
    body = FunctionType(code.__code__, code.__globals__ | others, code.__name__)
    body.__annotations__ = code.__annotations__
    return make(body)


def _reservation(shared_bytes: int) -> Any:
    """Return the function that reserves so many bytes of shared memory."""
    numbers = shared_bytes // 4

    @wp.func
    def reserve_shared_memory() -> None:
        """Reserve shared memory for a sculpture."""
        wp.tile_zeros(shape=wp.static(numbers), dtype=float, storage="shared")

    return reserve_shared_memory


def _nothing_packs() -> Any:
    """Return the function that says that no neck packs."""

    @wp.func
    def cores_may_pack() -> int:
        """Return 0."""
        return 0

    return cores_may_pack


def _half_a_warp() -> Any:
    """Return the function that says that half a warp moves a joint."""

    @wp.func
    def joint_lanes() -> int:
        """Return half a warp."""
        return int(wp.static(HALF_WARP))

    return joint_lanes
