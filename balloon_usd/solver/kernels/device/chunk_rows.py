"""Rows with one float for each quad of a chunk, so that a CPU tests all of them at once (SIMD), and lanes of
a GPU that search together share them out.

`rows`: (chunks, rows * CHUNK_QUADS); only these functions know the layout. A point against the 32 spheres of
a chunk takes 8 ns on a CPU with AVX-512, 150 ns one by one.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native
from balloon_usd.solver.kernels.device.search_lanes import LANES_TOGETHER, SEARCH_LANES
from balloon_usd.solver.kernels.device.warp_reduce import WARP

CHUNK_QUADS = WARP
"""Most quads of a chunk, the work of a warp, and the bits of a mask of them."""
SPHERE_ROWS = 4
"""Rows of spheres: coordinates of their middles, and their radii, m."""
REACH_ROWS = 5
"""Rows of what quads reach: coordinates of their middles, how far beside them and how high above, m."""

_PLACE = f"rows.data[size_t(chunk) * rows.shape[1] + row * {CHUNK_QUADS} + lane]"


@native(f"{_PLACE} = value;")
def put_in_row(rows: wp.array2d[float], chunk: int, row: int, lane: int, value: float):
    """Store the value of a chunk's quad `lane`."""
    ...


@native(f"return {_PLACE};")
def in_row(rows: wp.array2d[float], chunk: int, row: int, lane: int) -> float:
    """Return the value of a chunk's quad `lane`."""
    return rows[chunk, row * CHUNK_QUADS + lane]


@wp.func
def put_middle(rows: wp.array2d[float], chunk: int, lane: int, middle: wp.vec3):
    """Store the middle (m) of a chunk's quad `lane` in the first three rows."""
    for k in range(3):
        put_in_row(rows, chunk, k, lane, middle[k])


@native("return (int)(((1ull << end) - 1) & ~((1ull << begin) - 1));")
def lanes_between(begin: int, end: int) -> int:
    """Return the mask of the lanes from `begin` to `end`, 0 <= begin <= end <= 32."""
    return begin - end


_NEAR = f"""
#if defined(__CUDA_ARCH__)
const int tested = {CHUNK_QUADS // SEARCH_LANES}, first = tested * (threadIdx.x % {SEARCH_LANES});
#else
const int tested = {CHUNK_QUADS}, first = 0;
#endif
const float* row = rows.data + size_t(chunk) * rows.shape[1] + first;
const float x = p[0], y = p[1], z = p[2];
unsigned bits = 0;
for (int lane = 0; lane < tested; ++lane, ++row) {{
    const float dx = x - row[0], dy = y - row[{CHUNK_QUADS}], dz = z - row[2 * {CHUNK_QUADS}];
    LIMIT
    bits |= (dx * dx + dy * dy + dz * dz < square ? 1u : 0u) << lane;
}}
bits <<= first;
#if defined(__CUDA_ARCH__)
for (int step = 1; step < {SEARCH_LANES}; step <<= 1)
    bits |= __shfl_xor_sync({LANES_TOGETHER}, bits, step);
#endif
return (int)bits;
"""
_OVERLAP = f"const float near = radius + row[3 * {CHUNK_QUADS}], square = near * near;"
_REACH = f"""
const float beside = row[3 * {CHUNK_QUADS}], above = reach + row[4 * {CHUNK_QUADS}];
const float square = beside * beside + above * above;
"""


@native(_NEAR.replace("LIMIT", _OVERLAP))
def near_spheres(rows: wp.array2d[float], chunk: int, p: wp.vec3, radius: float) -> int:  # noqa: ARG001
    """Return the mask of those of 32 spheres of a chunk that a sphere about a point (m) overlaps; what it has
    for spheres that are not there must be masked. Lanes that search together ask for the same.
    """
    return chunk


@native(_NEAR.replace("LIMIT", _REACH))
def within_reach(rows: wp.array2d[float], chunk: int, p: wp.vec3, reach: float) -> int:  # noqa: ARG001
    """Return the mask of those of 32 quads of a chunk that a point (m) with a reach (m) may touch; what it
    has for quads that are not there must be masked. Lanes that search together ask for the same.
    """
    return chunk
