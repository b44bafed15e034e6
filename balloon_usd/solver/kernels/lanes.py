"""Lanes that work together on a GPU: sums over a warp, and where lanes, blocks and sculptures wait for each
other. On the CPU every lane is alone.
"""

from collections.abc import Callable
from typing import TypeVar, cast

import warp as wp

Stub = TypeVar("Stub")

WARP = 32
"""Lanes of a warp."""
FEW = 8
"""Lanes that sum what is too little for a warp."""


def _native(snippet: str) -> Callable[[Stub], Stub]:
    """Return the decorator that gives a stub its code, with the stub's own type."""
    return cast("Callable[[Stub], Stub]", wp.func_native(snippet))


_OVER_LANES = """
#if defined(__CUDA_ARCH__)
{type} total = value;
for (int step = {lanes} / 2; step > 0; step >>= 1)
    {add}
return total;
#else
return value;
#endif
"""


@_native(
    _OVER_LANES.format(lanes=WARP, type="float", add="total += __shfl_xor_sync(0xffffffffu, total, step);"),
)
def lanes_sum(value: float) -> float:
    """Return the sum over the lanes of a warp, in a fixed order."""
    return value


@_native(
    _OVER_LANES.format(
        lanes=FEW, type="float", add="total += __shfl_xor_sync(0xffu << (threadIdx.x & 24), total, step);"
    ),
)
def few_sum(value: float) -> float:
    """Return the sum over a few lanes, in a fixed order."""
    return value


@_native(
    _OVER_LANES.format(
        lanes=WARP,
        type="wp::vec_t<3, float>",
        add="for (int k = 0; k < 3; ++k) total[k] += __shfl_xor_sync(0xffffffffu, total[k], step);",
    ),
)
def lanes_sum3(value: wp.vec3) -> wp.vec3:
    """Return the sum over the lanes of a warp, in a fixed order."""
    return value


@_native(
    _OVER_LANES.format(
        lanes=WARP,
        type="wp::vec_t<3, float>",
        add="for (int k = 0; k < 3; ++k)"
        " total[k] = fmaxf(total[k], __shfl_xor_sync(0xffffffffu, total[k], step));",
    ),
)
def lanes_max3(value: wp.vec3) -> wp.vec3:
    """Return the largest value of every coordinate over the lanes of a warp."""
    return value


@_native("""
#if defined(__CUDA_ARCH__)
return (int)__ballot_sync(0xffffffffu, yes);
#else
return yes;
#endif
""")
def lanes_that(yes: int) -> int:
    """Return the bits of the lanes of a warp that say 1."""
    return yes


@_native("""
#if defined(__CUDA_ARCH__)
return 0;
#else
return 1;
#endif
""")
def lane_is_alone() -> int:
    """Return 1 on the CPU: what does not run there is not even compiled."""
    return 1


@_native("__builtin_assume(index >= 0); return index;")
def counted(index: int) -> int:
    """Return an index of which compilers may know that it is not negative, so counts from no array's end."""
    return index


@_native("""
#if defined(__CUDA_ARCH__)
return __ffs(bits) - 1;
#else
return 0;
#endif
""")
def lowest(bits: int) -> int:
    """Return the first of some lanes, given as bits that are not all 0."""
    return bits


@_native(
    _OVER_LANES.format(
        lanes=WARP, type="float", add="total = fminf(total, __shfl_xor_sync(0xffffffffu, total, step));"
    ),
)
def lanes_least(value: float) -> float:
    """Return the smallest value over the lanes of a warp."""
    return value


@_native(
    _OVER_LANES.format(
        lanes=WARP, type="int", add="total = max(total, __shfl_xor_sync(0xffffffffu, total, step));"
    ),
)
def lanes_most(value: int) -> int:
    """Return the largest value over the lanes of a warp."""
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
        asm volatile("red.release.gpu.global.add.s32 [%0], 1;" :: "l"(gate) : "memory");
        int come = 0;
        do {
            asm volatile("ld.acquire.gpu.global.s32 %0, [%1];" : "=r"(come) : "l"(gate) : "memory");
        } while (come < goal);
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
