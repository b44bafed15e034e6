"""The phases of a substep of the latex model, for one thread: walls, contact, gas, joints, motion, welds.

Between phases that need each other's results is a barrier, see `sculpture`. Idle threads take work from the
far end of a loop, so that those which are busy in one phase are spared in the next.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Chambers, Cores, Forces, Rubber, Struts
from balloon_usd.solver.kernels.arrays.rows import Air, Touch
from balloon_usd.solver.kernels.arrays.shared import (
    Balloons,
    Contacts,
    Hands,
    Joints,
    Mesh,
    Sculptures,
    State,
    Welds,
)
from balloon_usd.solver.kernels.device.array_access import (
    int_at,
    int_in,
    put_float,
    put_vec3,
    vec4_at,
    vec4i_at,
)
from balloon_usd.solver.kernels.device.barrier import block_barrier
from balloon_usd.solver.kernels.device.coherent_load import coherent_vec3
from balloon_usd.solver.kernels.device.warp_reduce import bit_of_rank, popcount, subwarp_sum, warp_sum
from balloon_usd.solver.kernels.physics.contact import limits_of_pair, press_quad_back, press_wall
from balloon_usd.solver.kernels.physics.core import press_core, yield_to_core
from balloon_usd.solver.kernels.physics.fingertip import push_of_fingertip
from balloon_usd.solver.kernels.physics.gas import advance_gas, shares_of_chunks, volume_of_fans
from balloon_usd.solver.kernels.physics.joints import (
    block_of_joint,
    joints_of_block,
    load_strut,
    measure_open_ring,
    move_joint,
    shift_middle,
    weld_joint_to_others,
)
from balloon_usd.solver.kernels.physics.membrane import wall_of_quad
from balloon_usd.solver.kernels.physics.membrane_simd import walls_simd
from balloon_usd.solver.kernels.physics.motion import move_vertex
from balloon_usd.solver.kernels.physics.work_sharing import (
    Launch,
    Ranges,
    Threads,
    share_from_far_end,
    share_of,
    share_of_others,
    wait_for_blocks,
)


@wp.func
def prepare_contacts(
    threads: Threads,
    own: Ranges,
    dt: float,
    touch: Touch,
    mesh: Mesh,
    balloons: Balloons,
    chambers: Chambers,
    contacts: Contacts,
    forces: Forces,
    state: State,
):
    """Write what stays constant for every contact until the next search."""
    # No barrier follows: `press_contacts` gives each contact to the same thread.
    first, last, step = share_from_far_end(threads, own.pair_begin, own.pair_end)
    for at in range(first, last, step):
        touched, limits = limits_of_pair(
            int_at(contacts.pairs, at),
            touch,
            dt,
            mesh,
            balloons,
            contacts,
            chambers.pressure,
            state.slowness,
            state.x,
        )
        forces.pair_corners[at] = touched
        forces.pair_limits[at] = limits


@wp.func
def press_fingers_in(
    threads: Threads,
    own: Ranges,
    world: int,
    goal: int,
    substep: int,
    launch: Launch,
    sculptures: Sculptures,
    mesh: Mesh,
    balloons: Balloons,
    hands: Hands,
    state: State,
):
    """Let fingers push out what is inside them, and return the goal of the last barrier.

    All velocities are read before any changes, and all are changed before any is read again.
    """
    fraction = float(substep + 1) / float(launch.substeps)
    first, last, step = share_of(threads, own.vertex_begin, own.vertex_end)
    for i in range(first, last, step):
        hands.finger_push[i] = push_of_fingertip(
            i, launch.dt, fraction, threads.shared, mesh, balloons, hands, state
        )
    goal = wait_for_blocks(launch, threads, sculptures, world, goal)
    # Each thread takes the vertices that it measured.
    for i in range(first, last, step):
        put_vec3(state.v, i, coherent_vec3(state.v, i, threads.shared) + hands.finger_push[i])
    return wait_for_blocks(launch, threads, sculptures, world, goal)


@wp.func
def stretch_walls(
    threads: Threads,
    own: Ranges,
    mesh: Mesh,
    rubber: Rubber,
    chambers: Chambers,
    forces: Forces,
    state: State,
):
    """Write the forces of the wall and the volume of every chunk."""
    # The SIMD variant is a CPU's: the block size is a constant, so a GPU does not compile it.
    if threads.block_size == 1:
        first, last, _step = share_of(threads, own.chunk_begin, own.chunk_end)
        walls_simd(first, last, mesh, rubber, chambers, forces, state)
    else:
        for c in range(own.chunk_begin + threads.warp, own.chunk_end, threads.warps):
            share = float(0.0)
            for q in range(
                int_at(mesh.chunk_quad, c) + threads.warp_lane,
                int_at(mesh.chunk_quad, c + 1),
                threads.warp_lanes,
            ):
                origin = coherent_vec3(state.x, int_at(mesh.chunk_origin, c), threads.shared)
                share += wall_of_quad(q, origin, threads.shared, mesh, rubber, forces, state)
            share = warp_sum(share)
            if threads.warp_lane == 0:
                put_float(chambers.chunk_share, c, share)


@wp.func
def measure_open_rings(threads: Threads, own: Ranges, joints: Joints, hands: Hands, state: State):
    """Write the vector areas of rings that are not being closed."""
    for j in range(own.joint_begin + threads.warps - 1 - threads.warp, own.joint_end, threads.warps):
        measure_open_ring(j, threads.warp_lane, threads.warp_lanes, threads.shared, joints, hands, state)


@wp.func
def press_contacts(
    threads: Threads,
    own: Ranges,
    dt: float,
    contacts: Contacts,
    forces: Forces,
    state: State,
):
    """Write the forces on vertices that touch a quad."""
    first, last, step = share_from_far_end(threads, own.pair_begin, own.pair_end)
    for at in range(first, last, step):
        press_wall(
            int_at(contacts.pairs, at),
            vec4i_at(forces.pair_corners, at),
            vec4_at(forces.pair_limits, at),
            dt,
            threads.shared,
            contacts,
            state,
        )


@wp.func
def press_quads_back(
    threads: Threads, own: Ranges, mesh: Mesh, contacts: Contacts, forces: Forces, state: State
):
    """Add the reactions of contacts to the forces on quads that are touched."""
    first, last, step = share_of_others(threads, own.quad_begin, own.pressed_end)
    for at in range(first, last, step):
        press_quad_back(int_at(contacts.pressed, at), threads.shared, mesh, contacts, forces, state)


@wp.func
def press_cores(
    threads: Threads, own: Ranges, dt: float, mesh: Mesh, cores: Cores, contacts: Contacts, state: State
):
    """Write the forces of cores that pack."""
    for m in range(own.core_begin + threads.warp, own.core_end, threads.warps):
        press_core(m, threads.warp_lane, threads.warp_lanes, dt, threads.shared, mesh, cores, contacts, state)


@wp.func
def yield_to_cores(
    threads: Threads, own: Ranges, dt: float, mesh: Mesh, cores: Cores, contacts: Contacts, state: State
):
    """Give vertices the speed that the forces of cores give them."""
    for m in range(own.core_begin + threads.warp, own.core_end, threads.warps):
        yield_to_core(
            m, threads.warp_lane, threads.warp_lanes, dt, threads.shared, mesh, cores, contacts, state
        )


@wp.func
def measure_volumes(
    threads: Threads, own: Ranges, mesh: Mesh, chambers: Chambers, joints: Joints, state: State
):
    """Write the volume of every segment, of the chunks of its wall and the fans that close it; one block."""
    lanes = threads.subwarp
    for first in range(own.segment_begin, own.segment_end, threads.block_size // lanes):
        s = first + threads.lane // lanes
        total = float(0.0)
        fans = float(0.0)
        if s < own.segment_end:
            chunk = int_at(mesh.segment_chunk, s) + threads.lane % lanes
            last = int_at(mesh.segment_chunk, s + 1)
            # The first four loads together with those of the fans: most segments have no more chunks.
            total = shares_of_chunks(chunk, lanes, last, chambers.chunk_share, threads.shared)
            fans = volume_of_fans(
                s,
                mesh.start_joint,
                mesh.end_joint,
                joints.ring_middle,
                joints.ring_area,
                coherent_vec3(state.x, int_at(mesh.segment_origin, s), threads.shared),
                threads.shared,
            )
            for c in range(chunk + 4 * lanes, last, 4 * lanes):
                total += shares_of_chunks(c, lanes, last, chambers.chunk_share, threads.shared)
        # Converged: every lane of the warp takes part in the shuffles.
        total = subwarp_sum(total)
        if s < own.segment_end and threads.lane % lanes == 0:
            put_float(state.volume, s, total + fans)


@wp.func
def advance_chambers(
    threads: Threads,
    own: Ranges,
    air: Air,
    dt: float,
    fraction: float,
    mesh: Mesh,
    chambers: Chambers,
    joints: Joints,
    state: State,
):
    """Advance the gas of all balloons; one block, in which it is the first threads that have work."""
    measure_volumes(threads, own, mesh, chambers, joints, state)
    block_barrier()
    # What lies in others comes after them: with their pressure of a substep before a thin wall between two
    # gases swings up.
    for inside in range(1 + wp.min(own.guests, 1)):
        if inside > 0:
            block_barrier()
        for b in range(own.balloon_begin + threads.block_warp, own.balloon_end, threads.block_warps):
            host = int_at(chambers.host_segment, int_at(chambers.balloon_segment, b))
            if own.guests == 0 or (host >= 0) == (inside > 0):
                advance_gas(b, threads.warp_lane, threads.warp_lanes, air, dt, fraction, chambers, state)


@wp.func
def load_struts(threads: Threads, own: Ranges, joints: Joints, struts: Struts):
    """Write the forces of all struts that have their first end at one of the sculpture's joints."""
    slots = struts.joint_struts.shape[1]
    for at in range(own.joint_begin * slots + threads.other, own.joint_end * slots, threads.others):
        strut = int_in(struts.joint_struts, at // slots, at % slots)
        if strut > 0:
            load_strut(strut - 1, threads.shared, joints, struts)


@wp.func
def joints_from(base: int, threads: Threads, own: Ranges, welds: Welds):
    """Return the mask of those joints from `base` on, one for each lane of a warp, that this block moves."""
    mine = int(own.own_joints)
    if base > own.joint_begin:
        mine = joints_of_block(
            base + threads.warp_lane,
            own.joint_begin,
            own.joint_end,
            threads.block,
            own.joint_blocks,
            welds.joint_leader,
        )
    return mine


@wp.func
def move_joints(
    launch: Launch,
    threads: Threads,
    own: Ranges,
    fraction: float,
    mesh: Mesh,
    balloons: Balloons,
    rubber: Rubber,
    chambers: Chambers,
    joints: Joints,
    welds: Welds,
    struts: Struts,
    hands: Hands,
    contacts: Contacts,
    forces: Forces,
    state: State,
):
    """Move the rings of this block's joints."""
    for base in range(own.joint_begin, own.joint_end, threads.warp_lanes):
        mine = joints_from(base, threads, own, welds)
        last = popcount(mine) - 1
        apart = threads.joint_groups * threads.block_warps
        for first in range(threads.joint_groups * threads.block_warp, last + 1, apart):
            rank = first + threads.warp_lane // threads.joint_group
            move_joint(
                base + bit_of_rank(mine, wp.min(rank, last)),
                rank > last,
                threads.lane % threads.joint_group,
                threads.joint_group,
                launch.dt,
                launch.frame_seconds,
                fraction,
                threads.shared,
                mesh,
                balloons,
                rubber,
                chambers,
                joints,
                struts,
                hands,
                contacts,
                forces,
                state,
            )


@wp.func
def move_vertices(
    threads: Threads,
    own: Ranges,
    dt: float,
    mesh: Mesh,
    balloons: Balloons,
    rubber: Rubber,
    chambers: Chambers,
    hands: Hands,
    contacts: Contacts,
    forces: Forces,
    state: State,
):
    """Move the vertices that belong to no joint."""
    first, last, step = share_from_far_end(threads, own.vertex_begin, own.vertex_end)
    for i in range(first, last, step):
        if int_at(mesh.vertex_joint, i) < 0:
            move_vertex(
                i, dt, threads.shared, mesh, balloons, rubber, chambers, hands, contacts, forces, state
            )


@wp.func
def weld_joints(
    launch: Launch,
    threads: Threads,
    own: Ranges,
    mesh: Mesh,
    balloons: Balloons,
    joints: Joints,
    welds: Welds,
    hands: Hands,
    state: State,
):
    """Keep welded joints together. A weld belongs to one block, so block barriers are enough."""
    block_barrier()
    for base in range(own.joint_begin, own.joint_end, threads.warp_lanes):
        mine = joints_from(base, threads, own, welds)
        last = popcount(mine) - 1
        apart = threads.joint_groups * threads.block_warps
        for first in range(threads.joint_groups * threads.block_warp, last + 1, apart):
            rank = first + threads.warp_lane // threads.joint_group
            weld_joint_to_others(
                base + bit_of_rank(mine, wp.min(rank, last)),
                rank > last,
                threads.lane % threads.joint_group,
                threads.joint_group,
                launch.dt,
                mesh,
                balloons,
                joints,
                welds,
                hands,
                state,
            )
    block_barrier()
    for j in range(own.joint_begin + threads.lane, own.joint_end, threads.block_size):
        block = block_of_joint(j, own.joint_begin, own.joint_end, own.joint_blocks, welds.joint_leader)
        if block == threads.block:
            shift_middle(j, welds.weld_shift, joints.ring_middle)
