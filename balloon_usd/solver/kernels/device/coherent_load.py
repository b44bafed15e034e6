"""Coherent loads: elements that another block may have written before the last barrier.

L1 is not coherent across the SMs of a GPU. Invalidating it at each barrier would evict constants too, so
mutable data is loaded from L2, which all SMs share. What a thread's own block wrote is loaded as usual, and
so is everything where one block has the sculpture for itself.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native

SINGLE_BLOCK_LANES = 256
"""Threads of a block that has a sculpture for itself; blocks that share one have fewer. The kernel knows its
block size at compile time, and so which of both it is.
"""

MULTI_BLOCK = f"defined(__CUDA_ARCH__) && WP_TILE_BLOCK_DIM < {SINGLE_BLOCK_LANES}"
"""Preprocessor condition: several blocks write to the sculpture."""
COHERENT_LOAD = 'asm volatile("ld.relaxed.gpu.global.f32 %0, [%1];" : "=f"({value}) : "l"({place}));'
"""Load of a float that bypasses L1."""


def _coherent(kind: str, numbers: int) -> str:
    """Return the C++ snippet that loads an element of so many floats."""
    loads = (COHERENT_LOAD.format(value=f"numbers[{k}]", place=f"place + {k}") for k in range(numbers))
    return f"""
#if {MULTI_BLOCK}
{kind} value;
float* numbers = reinterpret_cast<float*>(&value);
const float* place = reinterpret_cast<const float*>(values.data + i);
{" ".join(loads)}
return value;
#else
return values.data[i];
#endif
"""


@native(_coherent("float", 1))
def coherent_float(values: wp.array[float], i: int) -> float:
    """Return a float."""
    return values[i]


@native(_coherent("wp::vec_t<2, float>", 2))
def coherent_vec2(values: wp.array[wp.vec2], i: int) -> wp.vec2:
    """Return two floats."""
    return values[i]


@native(_coherent("wp::vec_t<3, float>", 3))
def coherent_vec3(values: wp.array[wp.vec3], i: int) -> wp.vec3:
    """Return three floats."""
    return values[i]
