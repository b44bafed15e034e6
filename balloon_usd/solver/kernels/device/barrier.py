"""Barriers between the lanes of a warp, the lanes of a block and the blocks of a sculpture. On the CPU there
is one lane, and none waits.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native


@native("""
#if defined(__CUDA_ARCH__)
__syncwarp();
#endif
""")
def warp_barrier():
    """Synchronise a warp: its lanes see each other's writes."""
    ...


@native("""
#if defined(__CUDA_ARCH__)
__syncthreads();
#endif
""")
def block_barrier():
    """Synchronise a block: its threads see each other's writes."""
    ...


@native("""
#if defined(__CUDA_ARCH__)
__syncthreads();
if (blocks > 1) {
    if (lane == 0) {
        int* count = barrier_counts.data + sculpture;
        asm volatile("red.release.gpu.global.add.s32 [%0], 1;" :: "l"(count) : "memory");
        int arrived = 0;
        do {
            asm volatile("ld.relaxed.gpu.global.s32 %0, [%1];" : "=r"(arrived) : "l"(count) : "memory");
        } while (arrived < goal);
    }
    __syncthreads();
}
#endif
""")
def sculpture_barrier(barrier_counts: wp.array[int], sculpture: int, blocks: int, goal: int, lane: int):
    """Synchronise the resident blocks of one sculpture: coherent loads see each other's writes.

    Arrival releases; the poll does not acquire, which would invalidate L1. PTX promises no order of the poll
    and the relaxed loads that follow: they rely on the block barrier in between, behind which no SM so far
    issues them before. All blocks must be resident: the launch shape sees to it.

    `goal`: what the sculpture's count reaches when all have arrived, `blocks` more than at the barrier
    before.
    """
    ...
