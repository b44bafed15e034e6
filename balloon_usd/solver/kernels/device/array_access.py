"""Elements of arrays by an index that counts from the beginning. `a[i]` of Warp asks at every reading whether
the index counts from the end, and how far apart elements lie: together a third of the instructions of a
substep.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native

_AT = "return values.data[i];"
_AT_ONCE = """
#if defined(__CUDA_ARCH__)
const float4 bits = *reinterpret_cast<const float4*>(values.data + i);
return reinterpret_cast<const {type}&>(bits);
#else
return values.data[i];
#endif
"""
"""What has 16 bytes, a GPU reads at once."""


@native(_AT)
def int_at(values: wp.array[int], i: int) -> int:
    """Return a whole number."""
    return values[i]


@native(_AT)
def float_at(values: wp.array[float], i: int) -> float:
    """Return a number."""
    return values[i]


@native(_AT)
def vec2_at(values: wp.array[wp.vec2], i: int) -> wp.vec2:
    """Return a pair of numbers."""
    return values[i]


@native(_AT)
def vec2i_at(values: wp.array[wp.vec2i], i: int) -> wp.vec2i:
    """Return a pair of whole numbers."""
    return values[i]


@native(_AT)
def vec3_at(values: wp.array[wp.vec3], i: int) -> wp.vec3:
    """Return a vector."""
    return values[i]


@native(_AT_ONCE.format(type="wp::vec_t<4, float>"))
def vec4_at(values: wp.array[wp.vec4], i: int) -> wp.vec4:
    """Return four numbers."""
    return values[i]


@native(_AT_ONCE.format(type="wp::vec_t<4, int>"))
def vec4i_at(values: wp.array[wp.vec4i], i: int) -> wp.vec4i:
    """Return four whole numbers."""
    return values[i]


@native(_AT_ONCE.format(type="wp::mat_t<2, 2, float>"))
def mat22_at(values: wp.array[wp.mat22], i: int) -> wp.mat22:
    """Return a matrix."""
    return values[i]


@native("return values.data[i * values.shape[1] + k];")
def int_in(values: wp.array2d[int], i: int, k: int) -> int:
    """Return a whole number of row `i`."""
    return values[i, k]


@native("values.data[i] = value;")
def put_float(values: wp.array[float], i: int, value: float):
    """Write a number."""
    ...


@native("values.data[i] = value;")
def put_vec3(values: wp.array[wp.vec3], i: int, value: wp.vec3):
    """Write a vector."""
    ...
