"""The kernel of a crew on a GPU, in variants that differ in what is known when they are compiled."""

from __future__ import annotations

from functools import cache
from types import FunctionType
from typing import Any

import warp as wp

from balloon_usd.solver.kernels.device.shared_memory import NEAR
from balloon_usd.solver.kernels.device.warp_reduce import HALF, WARP
from balloon_usd.solver.kernels.physics.sculpture import advance_sculptures

BESIDE = 2
"""Blocks that one processor can run at a time; where sculptures are at home, one."""
WARPS_OWN = 4096
"""Bytes inside a processor that Warp needs for itself."""


def room_inside(device: wp.Device) -> int:
    """Return how many bytes a block may have inside a processor of a GPU; on the CPU 0."""
    return int(device.max_shared_memory_per_block) - WARPS_OWN if device.is_cuda else 0


@cache
def quick_kernel(lanes: int, room: int, *, cores: bool, joint: int = WARP) -> Any:
    """Return the kernel with approximate divisions and roots: half of the code of exact ones is for numbers
    that cannot occur, and a GPU has to fetch it all in every substep.

    `lanes`: of a block; those beside each other share the registers of a processor. `room`: bytes inside a
    processor that a block takes where its sculpture is at home. `cores`: whether any neck may pack. `joint`:
    lanes that move a joint, all of a warp or half of them.
    """
    beside = 1 if lanes == NEAR else BESIDE
    make = wp.kernel(module="unique", module_options={"fast_math": True}, launch_bounds=(lanes, beside))
    others = {} if cores else {"cores_may_pack": _nothing_packs()}
    if joint < WARP:
        others["joint_lanes"] = _half_a_warp()
    if lanes == NEAR:
        others["take_room"] = _room_taker(room)
    # The same code, in which some names mean other functions.
    code = advance_sculptures.func
    body = FunctionType(code.__code__, code.__globals__ | others, code.__name__)
    body.__annotations__ = code.__annotations__
    return make(body)


def _room_taker(room: int) -> Any:
    """Return the function that takes so many bytes inside a processor."""
    numbers = room // 4

    @wp.func
    def take_room() -> None:
        """Take room for a sculpture."""
        wp.tile_zeros(shape=wp.static(numbers), dtype=float, storage="shared")

    return take_room


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
        """Return so many."""
        return int(wp.static(HALF))

    return joint_lanes
