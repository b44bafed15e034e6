"""Barriers between the lanes of a warp, the lanes of a block and the blocks of a sculpture. On the CPU a
block has one lane and is a thread of the operating system.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native

SPINS = 2000
"""Polls of a barrier on the CPU after which a thread yields its processor: some 100 us."""


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


@native(
    """
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
#else
if (blocks > 1) {
    int* count = barrier_counts.data + sculpture;
    int* round = barrier_rounds.data + sculpture;
    const int now = __atomic_load_n(round, __ATOMIC_ACQUIRE);
    if (__atomic_add_fetch(count, 1, __ATOMIC_ACQ_REL) == blocks) {
        __atomic_store_n(count, 0, __ATOMIC_RELAXED);
        __atomic_store_n(round, now + 1, __ATOMIC_RELEASE);
        return;
    }
    for (int spins = 0; __atomic_load_n(round, __ATOMIC_ACQUIRE) == now; ++spins) {
        if (spins >= SPINS) {
            reinterpret_cast<signed (*)()>(yield_processor)();
            continue;
        }
#if defined(__x86_64__)
        __builtin_ia32_pause();
#elif defined(__aarch64__)
        asm volatile("isb");
#endif
    }
}
#endif
""".replace("SPINS", str(SPINS))
)
def sculpture_barrier(
    barrier_counts: wp.array[int],
    barrier_rounds: wp.array[int],
    sculpture: int,
    blocks: int,
    goal: int,
    lane: int,
    yield_processor: wp.uint64,
):
    """Synchronise the blocks of one sculpture: coherent loads see each other's writes.

    On a GPU all must be resident: the launch shape sees to it. Arrival releases; the poll does not acquire,
    which would invalidate L1. PTX promises no order of the poll and the relaxed loads that follow: they rely
    on the block barrier in between, behind which no SM so far issues them before.

    On the CPU the last one to come begins another round, for which the others spin: a barrier comes every 30
    microseconds or so. When it is long in coming they yield their processors: one may have none to run on.

    `goal`: what the sculpture's count reaches on a GPU when all have arrived, `blocks` more than at the
    barrier before; `yield_processor`: address of the operating system's function that does so, of a CPU.
    """
    ...


@wp.kernel
def team_barrier(
    threads: int,
    yield_processor: wp.uint64,
    barrier_counts: wp.array[int],
    barrier_rounds: wp.array[int],
):
    """Synchronise the threads of a team, each of which launches this on the CPU."""
    sculpture_barrier(barrier_counts, barrier_rounds, 0, threads, 0, 0, yield_processor)
