"""The persistent kernel of the latex model: many substeps of all sculptures in one launch.

Several blocks share a sculpture and synchronise after walls, gas and motion, in place of a launch for each
law. Latency bounds it, not bandwidth: how long one value waits for the next. So loads are issued before
anything depends on them, and idle threads take work from the far end of a loop.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import Air, Axes, CurveSegment, Finger, Law, Spin, Touch
from balloon_usd.solver.kernels.device.array_access import (
    int_at,
    int_in,
    put_float,
    put_vec3,
    vec3_at,
    vec4_at,
    vec4i_at,
)
from balloon_usd.solver.kernels.device.barrier import block_barrier, sculpture_barrier
from balloon_usd.solver.kernels.device.coherent_load import coherent_vec3
from balloon_usd.solver.kernels.device.shared_memory import (
    QUAD_BYTES,
    VERTEX_BYTES,
    is_resident,
    reserve_shared_memory,
    resident_soa,
    resident_vectors,
)
from balloon_usd.solver.kernels.device.warp_reduce import (
    SUBWARP,
    WARP_LANES,
    bit_of_rank,
    block_lanes,
    joint_lanes,
    popcount,
    subwarp_sum,
    warp_sum,
)
from balloon_usd.solver.kernels.physics.contact import limits_of_pair, press_quad_back, press_wall
from balloon_usd.solver.kernels.physics.core import cores_may_pack, press_core, yield_to_core
from balloon_usd.solver.kernels.physics.fingers import press_finger
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

# Fused multiply-add: a tenth less time on a CPU.
wp.set_module_options(
    {"cpu_compiler_flags": f"{wp.config.cpu_compiler_flags or '-march=native'} -ffp-contract=fast"}
)

VERTEX_SIZE = wp.constant(VERTEX_BYTES)
QUAD_SIZE = wp.constant(QUAD_BYTES)
SUBWARP_LANES = wp.constant(SUBWARP)


@wp.kernel
def advance_sculptures(
    # Launch
    sculpture_blocks: int,
    joint_blocks: int,
    substeps: int,
    begin: int,
    end: int,
    walls: int,
    pressing: int,
    # Topology
    world_balloon: wp.array[int],
    world_quad: wp.array[int],
    world_vertex: wp.array[int],
    world_segment: wp.array[int],
    world_joint: wp.array[int],
    world_welds: wp.array[int],
    world_chunk: wp.array[int],
    world_core: wp.array[int],
    chunk_origin: wp.array[int],
    segment_chunk: wp.array[int],
    quads: wp.array[wp.vec4i],
    corners: wp.array[wp.vec4i],
    quad_segment: wp.array[int],
    quad_law: wp.array[int],
    segment_origin: wp.array[int],
    chunk_quad: wp.array[int],
    start_joint: wp.array[int],
    end_joint: wp.array[int],
    balloon_segment: wp.array[int],
    balloon_segment_end: wp.array[int],
    chamber_first: wp.array[int],
    chamber_last: wp.array[int],
    inlet: wp.array[int],
    vertex_joint: wp.array[int],
    vertex_balloon: wp.array[int],
    vertex_segment: wp.array[int],
    vertex_along: wp.array[float],
    joint_first: wp.array[int],
    joint_around: wp.array[int],
    joint_parts: wp.array[int],
    ring_cos_sin: wp.array[wp.vec2],
    joint_beside: wp.array[wp.vec2i],
    joint_struts: wp.array2d[int],
    strut_joint: wp.array[wp.vec2i],
    joint_leader: wp.array[int],
    joint_weld: wp.array[int],
    weld_joint: wp.array2d[int],
    weld_size: wp.array[int],
    ring_first: wp.array[int],
    ring_around: wp.array[int],
    core_ring: wp.array[int],
    core_next: wp.array[int],
    core_radius: wp.array[float],
    core_row: wp.array[float],
    # Material
    rest_inverse: wp.array[wp.mat22],
    hourglass: wp.array[wp.vec4],
    rubber_volume: wp.array[float],
    laws: wp.array[Law],
    curves: wp.array[CurveSegment],
    softening_rate: wp.array[float],
    mass: wp.array[float],
    true_mass: wp.array[float],
    joint_mass: wp.array[float],
    gravity: wp.array[float],
    drag: wp.array[float],
    friction: wp.array[float],
    air: Air,
    touch: Touch,
    strut_stiffness: wp.array[float],
    strut_damping: wp.array[float],
    strut_yield: wp.array[float],
    weld_reach: wp.array[float],
    weld_gap: wp.array[float],
    # Time step, hands and pump of the frame
    dt: float,
    frame_seconds: float,
    hand: wp.array[int],
    hand_from: wp.array[wp.vec3],
    hand_to: wp.array[wp.vec3],
    hand_free: wp.array[wp.vec3],
    hand_force: wp.array[float],
    hand_stiffness: wp.array[float],
    radius_from: wp.array[float],
    radius_to: wp.array[float],
    blowing: wp.array[int],
    open_from: wp.array[float],
    open_to: wp.array[float],
    pump_flow: wp.array[float],
    pump_limit: wp.array[float],
    pump_goal: wp.array[wp.float64],
    spin: wp.array[Spin],
    fingers: wp.array[Finger],
    finger_share: wp.array[float],
    # State
    x: wp.array[wp.vec3],
    ring_middle: wp.array[wp.vec3],
    ring_area: wp.array[wp.vec3],
    volume: wp.array[float],
    chamber_volume: wp.array[float],
    flow: wp.array[wp.float64],
    amount: wp.array[wp.float64],
    pressure: wp.array[float],
    area: wp.array[float],
    quad_area: wp.array[wp.vec3],
    ring_radius: wp.array[float],
    target: wp.array2d[int],
    hit_count: wp.array[int],
    pair_count: wp.array[int],
    pairs: wp.array[int],
    pressed_count: wp.array[int],
    pressed: wp.array[int],
    v: wp.array[wp.vec3],
    slip: wp.array2d[wp.vec3],
    contact_force: wp.array2d[float],
    contact_place: wp.array[wp.vec2],
    hits: wp.array2d[int],
    core_order: wp.array[wp.vec3],
    core_push: wp.array[wp.vec3],
    core_thrust: wp.array[wp.vec3],
    corner_force: wp.array2d[float],
    volume_gradient: wp.array2d[float],
    ring_velocity: wp.array[wp.vec3],
    strut_length: wp.array[float],
    strut_force: wp.array[wp.vec3],
    ring_axes: wp.array[Axes],
    hand_load: wp.array[wp.vec3],
    weld_shift: wp.array[wp.vec3],
    peak_energy: wp.array[float],
    # Scratch
    x_next: wp.array[wp.vec3],
    chunk_share: wp.array[float],
    pair_corners: wp.array[wp.vec4i],
    pair_limits: wp.array[wp.vec4],
    barrier_counts: wp.array[int],
):
    """Advance every sculpture from substep `begin` to `end` of its frame.

    `sculpture_blocks`: of each sculpture, all of which must run at once; the first `joint_blocks` move
    joints. `walls`: 1 where walls can touch; `pressing`: 1 where a finger presses. `barrier_counts`: zeros,
    one for each sculpture.
    """
    tile, lane = wp.tid()
    w = tile // sculpture_blocks
    block = tile % sculpture_blocks
    block_size = block_lanes()
    threads = sculpture_blocks * block_size
    thread = block * block_size + lane
    # A warp shares a chunk of quads, a segment or a balloon; on the CPU it has one lane.
    warp_lanes = wp.min(WARP_LANES, block_size)
    warp_lane = lane % warp_lanes
    subwarp = wp.min(SUBWARP_LANES, block_size)
    # Lanes that move one joint, and how many joints a warp moves at a time.
    joint_group = wp.min(joint_lanes(), block_size)
    joint_groups = warp_lanes // joint_group
    warps = threads // warp_lanes
    warp = thread // warp_lanes
    block_warps = block_size // warp_lanes
    block_warp = lane // warp_lanes
    # Block 0 advances the gas; the other blocks, if any, do the rest of that phase meanwhile.
    others = wp.max(threads - block_size, wp.min(threads, block_size))
    other = wp.where(sculpture_blocks > 1, thread - block_size, thread)
    # Loop invariants, loaded once.
    balloon_begin = int_at(world_balloon, w)
    balloon_end = int_at(world_balloon, w + 1)
    vertex_begin = int_at(world_vertex, w)
    vertex_end = int_at(world_vertex, w + 1)
    segment_begin = int_at(world_segment, w)
    segment_end = int_at(world_segment, w + 1)
    joint_begin = int_at(world_joint, w)
    joint_end = int_at(world_joint, w + 1)
    chunk_begin = int_at(world_chunk, w)
    chunk_end = int_at(world_chunk, w + 1)
    quad_begin = int_at(world_quad, w)
    quad_end = int_at(world_quad, w + 1)
    core_begin = int_at(world_core, w)
    core_end = wp.where(walls == 1, int_at(world_core, w + 1), core_begin)
    welds = int_at(world_welds, w)
    own_joints = joints_of_block(
        joint_begin + warp_lane, joint_begin, joint_end, block, joint_blocks, joint_leader
    )
    pair_begin = 2 * vertex_begin
    pair_end = pair_begin + int_at(pair_count, w)
    pressed_end = quad_begin + int_at(pressed_count, w)
    if walls == 1:
        # No barrier: each thread reads only what it wrote itself.
        for at in range(pair_begin + threads - 1 - thread, pair_end, threads):
            touched, limits = limits_of_pair(
                int_at(pairs, at),
                quads,
                mass,
                touch,
                friction,
                vertex_balloon,
                dt,
                area,
                quad_area,
                target,
                hit_count,
            )
            pair_corners[at] = touched
            pair_limits[at] = limits
    reserve_shared_memory()
    faces = quad_end - quad_begin
    vertex_bytes = VERTEX_SIZE * (vertex_end - vertex_begin)
    x_here = resident_vectors(x, vertex_begin, 0)
    v_here = resident_vectors(v, vertex_begin, vertex_bytes)
    force_here = resident_soa(corner_force, quad_begin, faces, 2 * vertex_bytes)
    gradient_here = resident_soa(volume_gradient, quad_begin, faces, 2 * vertex_bytes + QUAD_SIZE * faces)
    if is_resident() == 1:
        for i in range(vertex_begin + lane, vertex_end, block_size):
            put_vec3(x_here, i, vec3_at(x, i))
            put_vec3(v_here, i, vec3_at(v, i))
        block_barrier()
    goal = int(0)
    for k in range(begin, end):
        fraction = float(k + 1) / float(substeps)
        if pressing == 1:
            for i in range(vertex_begin + thread, vertex_end, threads):
                press_finger(i, vertex_balloon, mass, fingers, finger_share, dt, fraction, x_here, v_here)
            goal += sculpture_blocks
            sculpture_barrier(barrier_counts, w, sculpture_blocks, goal, lane)
        # Phase 1: forces of walls, contacts and cores. The SIMD variant is a CPU's: the block size is a
        # constant, so a GPU does not compile it.
        if block_size == 1:
            walls_simd(
                chunk_begin,
                chunk_end,
                quads,
                quad_law,
                chunk_quad,
                chunk_origin,
                rest_inverse,
                hourglass,
                rubber_volume,
                laws,
                curves,
                x_here,
                v_here,
                softening_rate,
                peak_energy,
                force_here,
                gradient_here,
                chunk_share,
            )
        else:
            for c in range(chunk_begin + warp, chunk_end, warps):
                share = float(0.0)
                for q in range(int_at(chunk_quad, c) + warp_lane, int_at(chunk_quad, c + 1), warp_lanes):
                    share += wall_of_quad(
                        q,
                        quads,
                        quad_law,
                        rest_inverse,
                        hourglass,
                        rubber_volume,
                        laws,
                        curves,
                        x_here,
                        v_here,
                        coherent_vec3(x_here, int_at(chunk_origin, c)),
                        softening_rate,
                        peak_energy,
                        force_here,
                        gradient_here,
                    )
                share = warp_sum(share)
                if warp_lane == 0:
                    put_float(chunk_share, c, share)
        for j in range(joint_begin + warps - 1 - warp, joint_end, warps):
            measure_open_ring(
                j,
                warp_lane,
                warp_lanes,
                joint_first,
                joint_around,
                joint_parts,
                radius_to,
                x_here,
                ring_middle,
                ring_area,
            )
        if walls == 1:
            for at in range(pair_begin + threads - 1 - thread, pair_end, threads):
                press_wall(
                    int_at(pairs, at),
                    vec4i_at(pair_corners, at),
                    vec4_at(pair_limits, at),
                    touch.offset,
                    dt,
                    x_here,
                    v_here,
                    slip,
                    contact_force,
                    contact_place,
                )
        if cores_may_pack() == 1:
            for m in range(core_begin + warp, core_end, warps):
                press_core(
                    m,
                    warp_lane,
                    warp_lanes,
                    ring_first,
                    ring_around,
                    ring_cos_sin,
                    core_ring,
                    core_next,
                    core_radius,
                    core_row,
                    mass,
                    dt,
                    ring_radius,
                    x_here,
                    core_order,
                    core_push,
                    core_thrust,
                )
        goal += sculpture_blocks
        sculpture_barrier(barrier_counts, w, sculpture_blocks, goal, lane)
        # Phase 2: volumes and gas; reactions of contacts, struts and cores meanwhile.
        if block == 0:
            for first in range(segment_begin, segment_end, block_size // subwarp):
                s = first + lane // subwarp
                total = float(0.0)
                fans = float(0.0)
                if s < segment_end:
                    chunk = int_at(segment_chunk, s) + lane % subwarp
                    last = int_at(segment_chunk, s + 1)
                    # The first four loads together with those of the fans: most segments have no more chunks.
                    total = shares_of_chunks(chunk, subwarp, last, chunk_share)
                    fans = volume_of_fans(
                        s,
                        start_joint,
                        end_joint,
                        ring_middle,
                        ring_area,
                        coherent_vec3(x_here, int_at(segment_origin, s)),
                    )
                    for c in range(chunk + 4 * subwarp, last, 4 * subwarp):
                        total += shares_of_chunks(c, subwarp, last, chunk_share)
                # Converged: every lane of the warp takes part in the shuffles.
                total = subwarp_sum(total)
                if s < segment_end and lane % subwarp == 0:
                    put_float(volume, s, total + fans)
            block_barrier()
            for b in range(balloon_begin + block_warp, balloon_end, block_warps):
                advance_gas(
                    b,
                    warp_lane,
                    warp_lanes,
                    balloon_segment,
                    balloon_segment_end,
                    chamber_first,
                    chamber_last,
                    end_joint,
                    inlet,
                    air,
                    dt,
                    fraction,
                    blowing,
                    open_from,
                    open_to,
                    pump_flow,
                    pump_limit,
                    pump_goal,
                    volume,
                    chamber_volume,
                    flow,
                    amount,
                    pressure,
                )
        if other >= 0:
            if walls == 1:
                # Backwards: with one block the first threads are busy with the gas.
                for at in range(quad_begin + others - 1 - other, pressed_end, others):
                    press_quad_back(
                        int_at(pressed, at),
                        quads,
                        hit_count,
                        hits,
                        contact_force,
                        contact_place,
                        x_here,
                        force_here,
                    )
            slots = joint_struts.shape[1]
            for at in range(joint_begin * slots + other, joint_end * slots, others):
                strut = int_in(joint_struts, at // slots, at % slots)
                if strut > 0:
                    load_strut(
                        strut - 1,
                        strut_joint,
                        strut_stiffness,
                        strut_damping,
                        strut_yield,
                        ring_middle,
                        ring_velocity,
                        strut_length,
                        strut_force,
                    )
        if cores_may_pack() == 1:
            for m in range(core_begin + warp, core_end, warps):
                yield_to_core(
                    m,
                    warp_lane,
                    warp_lanes,
                    ring_first,
                    ring_around,
                    core_ring,
                    core_next,
                    core_radius,
                    mass,
                    dt,
                    ring_radius,
                    core_order,
                    core_push,
                    core_thrust,
                    v_here,
                )
        goal += sculpture_blocks
        sculpture_barrier(barrier_counts, w, sculpture_blocks, goal, lane)
        # Phase 3: motion of joints and of the other vertices, then welds.
        for base in range(joint_begin, joint_end, warp_lanes):
            mine = int(own_joints)
            if base > joint_begin:
                mine = joints_of_block(
                    base + warp_lane, joint_begin, joint_end, block, joint_blocks, joint_leader
                )
            last = popcount(mine) - 1
            for first_rank in range(joint_groups * block_warp, last + 1, joint_groups * block_warps):
                rank = first_rank + warp_lane // joint_group
                move_joint(
                    base + bit_of_rank(mine, wp.min(rank, last)),
                    rank > last,
                    lane % joint_group,
                    joint_group,
                    corners,
                    vertex_balloon,
                    quad_segment,
                    vertex_along,
                    joint_first,
                    joint_around,
                    joint_parts,
                    joint_beside,
                    joint_struts,
                    ring_cos_sin,
                    mass,
                    true_mass,
                    joint_mass,
                    gravity,
                    drag,
                    dt,
                    frame_seconds,
                    fraction,
                    spin,
                    hand,
                    hand_from,
                    hand_to,
                    hand_free,
                    hand_force,
                    hand_stiffness,
                    radius_from,
                    radius_to,
                    contact_force,
                    force_here,
                    gradient_here,
                    pressure,
                    strut_force,
                    x_next,
                    x_here,
                    v_here,
                    ring_middle,
                    ring_area,
                    ring_axes,
                    ring_velocity,
                    hand_load,
                )
        for i in range(vertex_begin + threads - 1 - thread, vertex_end, threads):
            if int_at(vertex_joint, i) < 0:
                move_vertex(
                    i,
                    corners,
                    vertex_balloon,
                    vertex_segment,
                    quad_segment,
                    vertex_along,
                    mass,
                    true_mass,
                    gravity,
                    drag,
                    dt,
                    spin,
                    contact_force,
                    force_here,
                    gradient_here,
                    pressure,
                    x_here,
                    v_here,
                )
        if welds > 0:
            # A weld belongs to one block, so a block barrier is enough.
            block_barrier()
            for base in range(joint_begin, joint_end, warp_lanes):
                mine = int(own_joints)
                if base > joint_begin:
                    mine = joints_of_block(
                        base + warp_lane, joint_begin, joint_end, block, joint_blocks, joint_leader
                    )
                last = popcount(mine) - 1
                for first_rank in range(joint_groups * block_warp, last + 1, joint_groups * block_warps):
                    rank = first_rank + warp_lane // joint_group
                    weld_joint_to_others(
                        base + bit_of_rank(mine, wp.min(rank, last)),
                        rank > last,
                        lane % joint_group,
                        joint_group,
                        joint_weld,
                        weld_joint,
                        weld_size,
                        weld_reach,
                        weld_gap,
                        joint_first,
                        joint_around,
                        joint_mass,
                        hand,
                        dt,
                        ring_middle,
                        x_here,
                        v_here,
                        weld_shift,
                    )
            block_barrier()
            for j in range(joint_begin + lane, joint_end, block_size):
                if block_of_joint(j, joint_begin, joint_blocks, joint_leader) == block:
                    shift_middle(j, weld_shift, ring_middle)
        goal += sculpture_blocks
        sculpture_barrier(barrier_counts, w, sculpture_blocks, goal, lane)
    if is_resident() == 1:
        for i in range(vertex_begin + lane, vertex_end, block_size):
            put_vec3(x, i, vec3_at(x_here, i))
            put_vec3(v, i, vec3_at(v_here, i))
