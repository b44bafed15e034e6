"""Lanes that work together on a GPU: sums over a warp, and where lanes, blocks and sculptures wait for each
other. On the CPU every lane is alone.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native

WARP = 32
"""Lanes of a warp."""
HALF = 16
"""Lanes of half a warp."""
ALL = wp.constant(WARP)
FEW = 8
"""Lanes that sum what is too little for a warp."""


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


@native(
    _OVER_LANES.format(lanes=WARP, type="float", add="total += __shfl_xor_sync(0xffffffffu, total, step);"),
)
def lanes_sum(value: float) -> float:
    """Return the sum over the lanes of a warp, in a fixed order."""
    return value


@native(
    _OVER_LANES.format(lanes=FEW, type="float", add="total += __shfl_xor_sync(0xffffffffu, total, step);"),
)
def few_sum(value: float) -> float:
    """Return the sum over a few lanes, in a fixed order."""
    return value


@native("""
wp::vec_t<3, float> total = value;
#if defined(__CUDA_ARCH__)
for (int step = lanes / 2; step > 0; step >>= 1)
    for (int k = 0; k < 3; ++k) total[k] += __shfl_xor_sync(0xffffffffu, total[k], step);
#endif
return total;
""")
def lanes_sum3(value: wp.vec3, lanes: int) -> wp.vec3:  # noqa: ARG001  # in the native code
    """Return the sum over a warp, or over each half of it, so many `lanes`, in a fixed order."""
    return value


Vectors = wp.types.matrix(shape=(8, 3), dtype=float)
"""Eight vectors, as rows."""


@native(
    """
wp::mat_t<8, 3, float> total;
const wp::vec_t<3, float>* values[] = {&a, &b, &c, &d, &e, &f, &g, &h};
for (int row = 0; row < 8; ++row)
    for (int k = 0; k < 3; ++k) total.data[row][k] = values[row]->c[k];
#if defined(__CUDA_ARCH__)
for (int step = lanes / 2; step > 0; step >>= 1)
    for (int row = 0; row < 8; ++row)
        for (int k = 0; k < 3; ++k)
            total.data[row][k] += __shfl_xor_sync(0xffffffffu, total.data[row][k], step);
#endif
return total;
"""
)
def lanes_sum_all(
    a: wp.vec3,
    b: wp.vec3,
    c: wp.vec3,
    d: wp.vec3,
    e: wp.vec3,
    f: wp.vec3,
    g: wp.vec3,
    h: wp.vec3,
    lanes: int,  # noqa: ARG001  # in the native code
) -> Vectors:
    """Return the sums of eight vectors over a warp, or each half, in a fixed order: in the time of one."""
    return Vectors(*a, *b, *c, *d, *e, *f, *g, *h)


@native(
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


@native("""
#if defined(__CUDA_ARCH__)
return (int)__ballot_sync(0xffffffffu, yes);
#else
return yes;
#endif
""")
def lanes_that(yes: int) -> int:
    """Return the bits of the lanes of a warp that say 1."""
    return yes


@native("""
#if defined(__CUDA_ARCH__)
return __ffs(bits) - 1;
#else
return __builtin_ctz(bits);
#endif
""")
def lowest(bits: int) -> int:
    """Return the first of some bits that are not all 0, such as those of lanes."""
    return bits


@native(
    _OVER_LANES.format(
        lanes=WARP, type="int", add="total = max(total, __shfl_xor_sync(0xffffffffu, total, step));"
    ),
)
def lanes_most(value: int) -> int:
    """Return the largest value over the lanes of a warp."""
    return value


@native("""
#if defined(__CUDA_ARCH__)
return __popc(bits);
#else
return __builtin_popcount(bits);
#endif
""")
def bits_in(bits: int) -> int:
    """Return how many bits are set."""
    return bits


@wp.func
def bit_of_rank(bits: int, rank: int):
    """Return which bit has a rank, from 0, among those that are set."""
    left = int(bits)
    for _ in range(rank):
        left &= left - 1
    return lowest(left)


@wp.func
def joint_lanes():
    """Return how many lanes of a warp move a joint: all, or half of them where that is known to be enough."""
    return ALL


@native("return WP_TILE_BLOCK_DIM;")
def block_lanes() -> int:
    """Return how many lanes a block has: known when the kernel is compiled, as that of Warp is not."""
    return 1
