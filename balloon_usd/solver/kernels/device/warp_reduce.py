"""Reductions over a warp by shuffles, votes, and bits of lane masks. On the CPU a warp has one lane."""

import warp as wp

from balloon_usd.solver.kernels.device.native import native

WARP = 32
"""Lanes of a warp."""
HALF_WARP = 16
"""Lanes of half a warp."""
WARP_LANES = wp.constant(WARP)
SUBWARP = 8
"""Lanes of a subwarp, for sums too short for a warp."""


_REDUCE = """
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
    _REDUCE.format(lanes=WARP, type="float", add="total += __shfl_xor_sync(0xffffffffu, total, step);"),
)
def warp_sum(value: float) -> float:
    """Return the sum over the lanes of a warp, in a fixed order."""
    return value


@native(
    _REDUCE.format(lanes=SUBWARP, type="float", add="total += __shfl_xor_sync(0xffffffffu, total, step);"),
)
def subwarp_sum(value: float) -> float:
    """Return the sum over a subwarp, in a fixed order."""
    return value


@native("""
wp::vec_t<3, float> total = value;
#if defined(__CUDA_ARCH__)
for (int step = lanes / 2; step > 0; step >>= 1)
    for (int k = 0; k < 3; ++k) total[k] += __shfl_xor_sync(0xffffffffu, total[k], step);
#endif
return total;
""")
def warp_sum3(value: wp.vec3, lanes: int) -> wp.vec3:  # noqa: ARG001  # in the native code
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
def warp_sum8(
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
    """Return the sums of eight vectors over a warp, or each half, in a fixed order: interleaved, so that
    their shuffle latencies overlap.
    """
    return Vectors(*a, *b, *c, *d, *e, *f, *g, *h)


@native(
    _REDUCE.format(
        lanes=WARP,
        type="wp::vec_t<3, float>",
        add="for (int k = 0; k < 3; ++k)"
        " total[k] = fmaxf(total[k], __shfl_xor_sync(0xffffffffu, total[k], step));",
    ),
)
def warp_max3(value: wp.vec3) -> wp.vec3:
    """Return the largest value of every coordinate over the lanes of a warp."""
    return value


@native("""
#if defined(__CUDA_ARCH__)
return (int)__ballot_sync(0xffffffffu, yes);
#else
return yes;
#endif
""")
def warp_ballot(yes: int) -> int:
    """Return the mask of the lanes whose predicate is 1."""
    return yes


@native("""
#if defined(__CUDA_ARCH__)
return __ffs(bits) - 1;
#else
return __builtin_ctz(bits);
#endif
""")
def lowest_bit(bits: int) -> int:
    """Return the index of the lowest set bit of a mask that is not 0."""
    return bits


@native(
    _REDUCE.format(
        lanes=WARP, type="int", add="total = max(total, __shfl_xor_sync(0xffffffffu, total, step));"
    ),
)
def warp_max(value: int) -> int:
    """Return the largest value over the lanes of a warp."""
    return value


@native(
    _REDUCE.format(lanes=WARP, type="int", add="total |= __shfl_xor_sync(0xffffffffu, total, step);"),
)
def warp_or(value: int) -> int:
    """Return the mask of all bits that are set in any lane of a warp."""
    return value


@native("""
#if defined(__CUDA_ARCH__)
return __popc(bits);
#else
return __builtin_popcount(bits);
#endif
""")
def popcount(bits: int) -> int:
    """Return the number of set bits."""
    return bits


@wp.func
def bit_of_rank(bits: int, rank: int):
    """Return the index of the set bit of a rank, counted from 0."""
    left = int(bits)
    for _ in range(rank):
        left &= left - 1
    return lowest_bit(left)


@native("for (int k = 0; k < count; ++k) bits &= bits - 1; return bits;")
def without_lowest(bits: int, count: int) -> int:
    """Return a mask without so many of its lowest set bits."""
    return bits - count


@native("return WP_TILE_BLOCK_DIM;")
def block_lanes() -> int:
    """Return the block size as a compile-time constant, which `wp.block_dim()` is not."""
    return 1
