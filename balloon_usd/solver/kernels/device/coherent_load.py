"""Elements that another block may have written since the last meeting.

The cache beside a processor of a GPU does not hear of what others write. To empty it at every meeting would
throw away all that never changes, too; so what changes is read past it, from the cache that all share. What a
block wrote itself it may read as ever, and one that has a sculpture for itself has nobody to hear of.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native

ALONE = 256
"""Lanes of a block that has a sculpture for itself; other blocks have fewer."""

HEARS = f"defined(__CUDA_ARCH__) && WP_TILE_BLOCK_DIM < {ALONE}"
"""Where others write, in the devices' language."""
SEE = 'asm volatile("ld.relaxed.gpu.global.f32 %0, [%1];" : "=f"({value}) : "l"({place}));'
"""Reading a number past the near cache, in the devices' language."""


def _seen(kind: str, numbers: int) -> str:
    """Return the code that reads an element of so many numbers."""
    readings = (SEE.format(value=f"numbers[{k}]", place=f"place + {k}") for k in range(numbers))
    return f"""
#if {HEARS}
{kind} value;
float* numbers = reinterpret_cast<float*>(&value);
const float* place = reinterpret_cast<const float*>(values.data + i);
{" ".join(readings)}
return value;
#else
return values.data[i];
#endif
"""


@native(_seen("float", 1))
def float_seen(values: wp.array[float], i: int) -> float:
    """Return a number."""
    return values[i]


@native(_seen("wp::vec_t<2, float>", 2))
def vec2_seen(values: wp.array[wp.vec2], i: int) -> wp.vec2:
    """Return a pair of numbers."""
    return values[i]


@native(_seen("wp::vec_t<3, float>", 3))
def vec3_seen(values: wp.array[wp.vec3], i: int) -> wp.vec3:
    """Return a vector."""
    return values[i]
