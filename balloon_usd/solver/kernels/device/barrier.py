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
def lanes_meet():
    """Let the lanes of a warp see what the others wrote."""
    ...


@native("""
#if defined(__CUDA_ARCH__)
__syncthreads();
#endif
""")
def block_meets():
    """Let the lanes of a block see what the others wrote."""
    ...


@native("""
#if defined(__CUDA_ARCH__)
__syncthreads();
if (blocks > 1) {
    if (lane == 0) {
        int* gate = gates.data + sculpture;
        asm volatile("red.release.gpu.global.add.s32 [%0], 1;" :: "l"(gate) : "memory");
        int come = 0;
        do {
            asm volatile("ld.relaxed.gpu.global.s32 %0, [%1];" : "=r"(come) : "l"(gate) : "memory");
        } while (come < goal);
    }
    __syncthreads();
}
#endif
""")
def blocks_meet(gates: wp.array[int], sculpture: int, blocks: int, goal: int, lane: int):
    """Let all blocks of a sculpture see what the others wrote, where they read it as `seen`.

    `goal`: what its gate counts when all have come, `blocks` more than at the last meeting.
    """
    ...
