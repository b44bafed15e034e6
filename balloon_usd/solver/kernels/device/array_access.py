"""Unchecked access to contiguous arrays. Warp's own `a[i]` wraps negative indices and multiplies by the
stride at every access: together a third of the instructions of a substep.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native

_LOAD = "return values.data[i];"
_LOAD_16_BYTES = """
#if defined(__CUDA_ARCH__)
const float4 bits = *reinterpret_cast<const float4*>(values.data + i);
return reinterpret_cast<const {type}&>(bits);
#else
return values.data[i];
#endif
"""
"""One vector load on a GPU."""


@native(_LOAD)
def int_at(values: wp.array[int], i: int) -> int:
    """Return an int."""
    return values[i]


@native(_LOAD)
def float_at(values: wp.array[float], i: int) -> float:
    """Return a float."""
    return values[i]


@native(_LOAD)
def vec2_at(values: wp.array[wp.vec2], i: int) -> wp.vec2:
    """Return two floats."""
    return values[i]


@native(_LOAD)
def vec2i_at(values: wp.array[wp.vec2i], i: int) -> wp.vec2i:
    """Return two ints."""
    return values[i]


@native(_LOAD)
def vec3_at(values: wp.array[wp.vec3], i: int) -> wp.vec3:
    """Return three floats."""
    return values[i]


@native(_LOAD_16_BYTES.format(type="wp::vec_t<4, float>"))
def vec4_at(values: wp.array[wp.vec4], i: int) -> wp.vec4:
    """Return four floats."""
    return values[i]


@native(_LOAD_16_BYTES.format(type="wp::vec_t<4, int>"))
def vec4i_at(values: wp.array[wp.vec4i], i: int) -> wp.vec4i:
    """Return four ints."""
    return values[i]


@native(_LOAD_16_BYTES.format(type="wp::mat_t<2, 2, float>"))
def mat22_at(values: wp.array[wp.mat22], i: int) -> wp.mat22:
    """Return a 2 x 2 matrix."""
    return values[i]


@native("return values.data[i * values.shape[1] + k];")
def int_in(values: wp.array2d[int], i: int, k: int) -> int:
    """Return the int in row `i`, column `k`."""
    return values[i, k]


@native("values.data[i] = value;")
def put_float(values: wp.array[float], i: int, value: float):
    """Store a float."""
    ...


@native("values.data[i] = value;")
def put_vec3(values: wp.array[wp.vec3], i: int, value: wp.vec3):
    """Store three floats."""
    ...
