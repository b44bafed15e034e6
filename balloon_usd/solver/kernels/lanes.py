"""Lanes that work together on a GPU: sums over a warp, and where lanes, blocks and sculptures wait for each
other. On the CPU every lane is alone.
"""

from collections.abc import Callable
from typing import TypeVar, cast

import warp as wp

Stub = TypeVar("Stub")

WARP = 32
"""Lanes of a warp."""


def _native(snippet: str) -> Callable[[Stub], Stub]:
    """Return the decorator that gives a stub its code, with the stub's own type."""
    return cast("Callable[[Stub], Stub]", wp.func_native(snippet))


_SUM = """
#if defined(__CUDA_ARCH__)
{type} total = value;
for (int step = 16; step > 0; step >>= 1)
    {add}
return total;
#else
return value;
#endif
"""


@_native(
    _SUM.format(type="float", add="total += __shfl_xor_sync(0xffffffffu, total, step);"),
)
def lanes_sum(value: float) -> float:
    """Return the sum over the lanes of a warp, in a fixed order."""
    return value


@_native(
    _SUM.format(
        type="wp::vec_t<3, float>",
        add="for (int k = 0; k < 3; ++k) total[k] += __shfl_xor_sync(0xffffffffu, total[k], step);",
    ),
)
def lanes_sum3(value: wp.vec3) -> wp.vec3:
    """Return the sum over the lanes of a warp, in a fixed order."""
    return value


@_native("""
#if defined(__CUDA_ARCH__)
__syncwarp();
#endif
""")
def lanes_meet():
    """Let the lanes of a warp see what the others wrote."""
    ...


@_native("""
#if defined(__CUDA_ARCH__)
__syncthreads();
#endif
""")
def block_meets():
    """Let the lanes of a block see what the others wrote."""
    ...


@_native("""
#if defined(__CUDA_ARCH__)
__syncthreads();
if (blocks > 1) {
    if (lane == 0) {
        int* gate = gates.data + sculpture;
        __threadfence();
        atomicAdd(gate, 1);
        while (*((volatile int*)gate) < goal) { }
        __threadfence();
    }
    __syncthreads();
}
#endif
""")
def blocks_meet(gates: wp.array[int], sculpture: int, blocks: int, goal: int, lane: int):
    """Let all blocks of a sculpture see what the others wrote.

    `goal`: what its gate counts when all have come, `blocks` more than at the last meeting.
    """
    ...
