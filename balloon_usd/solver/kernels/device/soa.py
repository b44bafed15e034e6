"""Vectors of quads and vertices in planes of one coordinate each: neighbouring lanes of a GPU then write
neighbouring words. A CPU's one lane writes all of one quad together.

`planes`: (3 vectors, items); only these functions know where in it what lies.
"""

import warp as wp

from balloon_usd.solver.kernels.device.coherent_load import HEARS, SEE
from balloon_usd.solver.kernels.device.native import native

_PLACE = """
#if defined(__CUDA_ARCH__)
const size_t step = planes.shape[1];
float* place = planes.data + 3 * k * step + item;
#else
const size_t step = 1;
float* place = planes.data + size_t(item) * planes.shape[0] + 3 * k;
#endif
"""


@native(
    _PLACE
    + """
place[0] = value[0];
place[step] = value[1];
place[2 * step] = value[2];
"""
)
def put(planes: wp.array2d[float], item: int, k: int, value: wp.vec3):
    """Write vector `k` of an item."""
    ...


_SEEN = "wp::vec_t<3, float> value;\n" + " ".join(
    SEE.format(value=f"value.c[{k}]", place=f"place + {k} * step") for k in range(3)
)


@native(
    _PLACE
    + f"""
#if {HEARS}
{_SEEN}
return value;
#else
return wp::vec_t<3, float>(place[0], place[step], place[2 * step]);
#endif
"""
)
def seen_in(planes: wp.array2d[float], item: int, k: int) -> wp.vec3:
    """Return vector `k` of an item, that another block may have written since the last meeting."""
    return wp.vec3(planes[item, k])
