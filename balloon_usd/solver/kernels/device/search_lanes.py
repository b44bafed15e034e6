"""Neighbouring lanes of a warp that search together for one vertex or one quad. On the CPU it is one lane.

A search takes as long as its slowest warp, that of the most candidates: so each takes few vertices or quads,
and shares out the candidates of each (10,500 vertices on an H100: 220 -> 84 us for facing walls, 48 -> 27 us
for what pierces what).
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native
from balloon_usd.solver.kernels.device.warp_reduce import WARP, block_lanes

SEARCH_LANES = 4
"""Lanes that search together on a GPU, a power of 2."""
_SEARCH_LANES = wp.constant(SEARCH_LANES)

LANES_TOGETHER = f"({(1 << SEARCH_LANES) - 1}u << (threadIdx.x & {WARP - SEARCH_LANES}))"
"""Mask of the lanes that search together with this one, in CUDA."""
_FROM_BESIDE = f"""
#if defined(__CUDA_ARCH__)
return __shfl_xor_sync({LANES_TOGETHER}, value, step);
#else
return value;
#endif
"""


@wp.func
def search_lanes():
    """Return how many lanes search together, a constant once the kernel is compiled."""
    return wp.min(_SEARCH_LANES, block_lanes())


@native(_FROM_BESIDE)
def float_from_beside(value: float, step: int) -> float:
    """Return the value of the lane whose index differs in the bit `step`."""
    return value + float(step)


@native(_FROM_BESIDE)
def int_from_beside(value: int, step: int) -> int:
    """Return the value of the lane whose index differs in the bit `step`."""
    return value + step
