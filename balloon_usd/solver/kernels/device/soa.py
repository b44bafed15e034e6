"""Structure of arrays: one plane for each coordinate of the vectors of quads and vertices, so that
neighbouring lanes of a GPU access neighbouring words. A CPU, which works through one item at a time, keeps an
item's vectors together instead.

`planes`: (3 * vectors, items); only these functions know the layout.
"""

import warp as wp

from balloon_usd.solver.kernels.device.coherent_load import COHERENT_LOAD
from balloon_usd.solver.kernels.device.native import native

_ADDRESS = """
#if defined(__CUDA_ARCH__)
const size_t step = planes.shape[1];
float* place = planes.data + 3 * k * step + item;
#else
const size_t step = 1;
float* place = planes.data + size_t(item) * planes.shape[0] + 3 * k;
#endif
"""


@native(
    _ADDRESS
    + """
place[0] = value[0];
place[step] = value[1];
place[2 * step] = value[2];
"""
)
def store_soa(planes: wp.array2d[float], item: int, k: int, value: wp.vec3):
    """Store vector `k` of an item."""
    ...


_LOAD = "wp::vec_t<3, float> value;\n" + " ".join(
    COHERENT_LOAD.format(value=f"value.c[{k}]", place=f"place + {k} * step") for k in range(3)
)


@native(
    _ADDRESS
    + f"""
#if defined(__CUDA_ARCH__)
if (shared) {{
    {_LOAD}
    return value;
}}
#endif
return wp::vec_t<3, float>(place[0], place[step], place[2 * step]);
"""
)
def load_soa(planes: wp.array2d[float], item: int, k: int, shared: int) -> wp.vec3:  # noqa: ARG001
    """Return vector `k` of an item; coherently where `shared` is 1."""
    return wp.vec3(planes[item, k])
