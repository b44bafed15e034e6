"""How threads share the work on a sculpture: which of them each is, and what belongs to the sculpture."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Cores
from balloon_usd.solver.kernels.arrays.shared import Contacts, Sculptures, Welds
from balloon_usd.solver.kernels.device.array_access import int_at
from balloon_usd.solver.kernels.device.barrier import sculpture_barrier
from balloon_usd.solver.kernels.device.warp_reduce import SUBWARP, WARP_LANES, block_lanes
from balloon_usd.solver.kernels.physics.joints import joints_of_block

SUBWARP_LANES = wp.constant(SUBWARP)


@wp.struct
class Launch:
    """One launch of the persistent kernel."""

    team: int
    """Threads of the CPU that share each sculpture, every one a block of its own; on a GPU `world_block`
    tells the blocks of each, all of which must run at once."""
    member: int
    """Which thread of the team launches this."""
    yield_processor: wp.uint64
    """Address of the function with which a thread of the CPU yields its processor."""
    substeps: int
    """Substeps of a frame."""
    begin: int
    """First substep of this launch."""
    end: int
    """End of its substeps."""
    walls: int
    """1 where walls can touch."""
    pressing: int
    """1 where a finger presses."""
    dt: float
    """Time step, s."""
    frame_seconds: float
    """Duration of a frame, s."""


@wp.struct
class Threads:
    """One thread among those of its sculpture. A warp shares a chunk of quads, a segment or a balloon; on the
    CPU it has one lane.
    """

    shared: int
    """1 where other blocks write to the sculpture too, a constant of the kernel: see `coherent_load`."""
    blocks: int
    """Blocks of the sculpture."""
    block: int
    """Which of them this is."""
    block_size: int
    """Threads of a block, a constant once the kernel is compiled."""
    lane: int
    """Thread of the block."""
    threads: int
    """Threads of the sculpture."""
    thread: int
    """Which of them this is."""
    warps: int
    """Warps of the sculpture."""
    warp: int
    """Which of them this is."""
    warp_lanes: int
    """Lanes of a warp."""
    warp_lane: int
    """Which of them this is."""
    block_warps: int
    """Warps of a block."""
    block_warp: int
    """Which of them this is."""
    subwarp: int
    """Lanes of a subwarp."""
    joint_group: int
    """Lanes that move one joint."""
    joint_groups: int
    """Joints that a warp moves at a time."""
    others: int
    """Threads that do not advance the gas, if there are any: else all."""
    other: int
    """Which of them this is; negative for one that advances the gas."""


@wp.struct
class Ranges:
    """What belongs to a sculpture: begin and end among all balloons, vertices and so on."""

    balloon_begin: int
    balloon_end: int
    vertex_begin: int
    vertex_end: int
    segment_begin: int
    segment_end: int
    joint_begin: int
    joint_end: int
    chunk_begin: int
    chunk_end: int
    quad_begin: int
    quad_end: int
    core_begin: int
    core_end: int
    """None where walls cannot touch."""
    pair_begin: int
    pair_end: int
    pressed_end: int
    """End of the list of touched quads, which begins with the first quad."""
    welds: int
    """Number of its welds."""
    guests: int
    """Number of its balloons that lie in others."""
    joint_blocks: int
    """Blocks of the sculpture that move joints: those without vertices, if there are any, else all."""
    own_joints: int
    """Mask of the lanes of the warp whose joint, of the first ones, is of this block."""


@wp.func
def threads_of(blocks: int, block: int, lane: int, joint_lanes: int, shared: int):
    """Return the thread `lane` of a block of so many; `joint_lanes`: lanes that move one joint."""
    t = Threads()
    t.shared = shared
    t.blocks = blocks
    t.block = block
    t.block_size = block_lanes()
    t.lane = lane
    t.threads = blocks * t.block_size
    t.thread = t.block * t.block_size + lane
    t.warp_lanes = wp.min(WARP_LANES, t.block_size)
    t.warp_lane = lane % t.warp_lanes
    t.subwarp = wp.min(SUBWARP_LANES, t.block_size)
    t.joint_group = wp.min(joint_lanes, t.block_size)
    t.joint_groups = t.warp_lanes // t.joint_group
    t.warps = t.threads // t.warp_lanes
    t.warp = t.thread // t.warp_lanes
    t.block_warps = t.block_size // t.warp_lanes
    t.block_warp = lane // t.warp_lanes
    # Block 0 advances the gas; the other blocks, if any, do the rest of that phase meanwhile.
    t.others = wp.max(t.threads - t.block_size, wp.min(t.threads, t.block_size))
    t.other = wp.where(blocks > 1, t.thread - t.block_size, t.thread)
    if t.block_size == 1:
        # Of a CPU's threads none has much more to do for the gas than others.
        t.others = t.threads
        t.other = t.thread
    return t


@wp.func
def wait_for_blocks(launch: Launch, threads: Threads, sculptures: Sculptures, world: int, goal: int):
    """Synchronise the blocks of a sculpture, and return the goal of this barrier; `goal`: of the last."""
    reached = goal + threads.blocks
    sculpture_barrier(
        sculptures.barrier_counts,
        sculptures.barrier_rounds,
        world,
        threads.blocks,
        reached,
        threads.lane,
        launch.yield_processor,
    )
    return reached


@wp.func
def share_of(threads: Threads, begin: int, end: int):
    """Return the begin, end and step of what a thread takes of a range.

    On a GPU, items that lie as far apart as there are threads, so that loads coalesce. On the CPU, a stretch,
    so that threads do not write to each other's cache lines, the same one of everything in the order of the
    mesh: what a thread has written it finds in its own cache.
    """
    first = begin + threads.thread
    last = end
    step = threads.threads
    if threads.block_size == 1:
        first = begin + (end - begin) * threads.thread // threads.threads
        last = begin + (end - begin) * (threads.thread + 1) // threads.threads
        step = int(1)
    return first, last, step


@wp.func
def share_from_far_end(threads: Threads, begin: int, end: int):
    """Return the same, given out from the far end of the threads on a GPU: the near ones have other work."""
    first, last, step = share_of(threads, begin, end)
    if threads.block_size > 1:
        first = begin + threads.threads - 1 - threads.thread
    return first, last, step


@wp.func
def share_of_others(threads: Threads, begin: int, end: int):
    """Return the same among the threads that do not advance the gas, backwards: with one block the first
    threads are busy with it. On the CPU all take part.
    """
    first, last, step = share_of(threads, begin, end)
    if threads.block_size > 1:
        first = begin + threads.others - 1 - threads.other
        step = threads.others
    return first, last, step


@wp.func
def ranges_of(
    w: int,
    launch: Launch,
    threads: Threads,
    sculptures: Sculptures,
    welds: Welds,
    cores: Cores,
    contacts: Contacts,
):
    """Return what belongs to sculpture `w`."""
    r = Ranges()
    r.balloon_begin = int_at(sculptures.world_balloon, w)
    r.balloon_end = int_at(sculptures.world_balloon, w + 1)
    r.vertex_begin = int_at(sculptures.world_vertex, w)
    r.vertex_end = int_at(sculptures.world_vertex, w + 1)
    r.segment_begin = int_at(sculptures.world_segment, w)
    r.segment_end = int_at(sculptures.world_segment, w + 1)
    r.joint_begin = int_at(sculptures.world_joint, w)
    r.joint_end = int_at(sculptures.world_joint, w + 1)
    r.chunk_begin = int_at(sculptures.world_chunk, w)
    r.chunk_end = int_at(sculptures.world_chunk, w + 1)
    r.quad_begin = int_at(sculptures.world_quad, w)
    r.quad_end = int_at(sculptures.world_quad, w + 1)
    r.core_begin = int_at(cores.world_core, w)
    r.core_end = wp.where(launch.walls == 1, int_at(cores.world_core, w + 1), r.core_begin)
    r.pair_begin = 2 * r.vertex_begin
    r.pair_end = r.pair_begin + int_at(contacts.pair_count, w)
    r.pressed_end = r.quad_begin + int_at(contacts.pressed_count, w)
    r.welds = int_at(sculptures.world_welds, w)
    r.guests = int_at(sculptures.world_guests, w)
    with_vertices = (r.vertex_end - r.vertex_begin + threads.block_size - 1) // threads.block_size
    r.joint_blocks = wp.where(threads.blocks > with_vertices, threads.blocks - with_vertices, threads.blocks)
    r.own_joints = joints_of_block(
        r.joint_begin + threads.warp_lane,
        r.joint_begin,
        r.joint_end,
        threads.block,
        r.joint_blocks,
        welds.joint_leader,
    )
    return r
