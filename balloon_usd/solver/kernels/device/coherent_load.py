"""Coherent loads: elements that another block may have written before the last barrier.

L1 is not coherent across the SMs of a GPU. Invalidating it at each barrier would evict constants too, so
mutable data is loaded from L2, which all SMs share. What a thread's own block wrote is loaded as usual, and
so is everything where one block has the sculpture for itself: `shared` is 1 where it has not. The kernel
gives it as a constant, so that no branch is left.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native

COHERENT_LOAD = 'asm volatile("ld.relaxed.gpu.global.f32 %0, [%1];" : "=f"({value}) : "l"({place}));'
"""Load of a float that bypasses L1."""


def _coherent(kind: str, numbers: int) -> str:
    """Return the C++ snippet that loads an element of so many floats."""
    loads = (COHERENT_LOAD.format(value=f"numbers[{k}]", place=f"place + {k}") for k in range(numbers))
    return f"""
#if defined(__CUDA_ARCH__)
if (shared) {{
    {kind} value;
    float* numbers = reinterpret_cast<float*>(&value);
    const float* place = reinterpret_cast<const float*>(values.data + i);
    {" ".join(loads)}
    return value;
}}
#endif
return values.data[i];
"""


@native(_coherent("float", 1))
def coherent_float(values: wp.array[float], i: int, shared: int) -> float:  # noqa: ARG001  # in the native code
    """Return a float."""
    return values[i]


@native(_coherent("wp::vec_t<2, float>", 2))
def coherent_vec2(values: wp.array[wp.vec2], i: int, shared: int) -> wp.vec2:  # noqa: ARG001  # likewise
    """Return two floats."""
    return values[i]


@native(_coherent("wp::vec_t<3, float>", 3))
def coherent_vec3(values: wp.array[wp.vec3], i: int, shared: int) -> wp.vec3:  # noqa: ARG001  # likewise
    """Return three floats."""
    return values[i]
