"""The persistent kernel of the latex model: many substeps of all sculptures in one launch.

Several blocks share a sculpture and synchronise after walls, gas and motion, in place of a launch for each
law. Latency bounds it, not bandwidth: how long one value waits for the next. So loads are issued before
anything depends on them, and idle threads take work from the far end of a loop.
"""

from typing import Any

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
from balloon_usd.solver.kernels.device.array_access import int_at
from balloon_usd.solver.kernels.device.barrier import block_barrier
from balloon_usd.solver.kernels.device.warp_reduce import WARP
from balloon_usd.solver.kernels.physics.phases import (
    advance_chambers,
    load_struts,
    measure_open_rings,
    move_joints,
    move_vertices,
    prepare_contacts,
    press_contacts,
    press_cores,
    press_fingers_in,
    press_quads_back,
    stretch_walls,
    weld_joints,
    yield_to_cores,
)
from balloon_usd.solver.kernels.physics.residence import (
    copy_state,
    forces_in_shared_memory,
    shared_memory_of,
    state_in_shared_memory,
)
from balloon_usd.solver.kernels.physics.work_sharing import (
    Launch,
    ranges_of,
    threads_of,
    wait_for_blocks,
)

# Fused multiply-add: 5 to 10 % less time on a CPU.
wp.set_module_options(
    {"cpu_compiler_flags": f"{wp.config.cpu_compiler_flags or '-march=native'} -ffp-contract=fast"}
)


def substep_kernel(
    *,
    hosted: bool = False,
    shared: bool = False,
    cores: bool = True,
    fingers: bool = True,
    joint_lanes: int = WARP,
    resident_bytes: int = 0,
    **options: Any,
) -> wp.Kernel:
    """Return the persistent kernel, made for some scenes.

    Args:
        hosted: whether blocks are threads of the CPU, each of which launches the kernel.
        shared: whether several blocks share a sculpture.
        cores: whether any neck may pack.
        fingers: whether any finger may press: its code takes registers from the rest.
        joint_lanes: lanes that move a joint, a warp or half of one.
        resident_bytes: shared memory of a block, where a sculpture is resident in it; 0 where none is.
        options: of `wp.kernel`.
    """
    packing, handled = cores, fingers
    reserve_shared_memory = shared_memory_of(resident_bytes)

    @wp.kernel(name="advance_sculptures", **options)
    def advance_sculptures(
        launch: Launch,
        air: Air,
        touch: Touch,
        sculptures: Sculptures,
        mesh: Mesh,
        balloons: Balloons,
        rubber: Rubber,
        chambers: Chambers,
        joints: Joints,
        welds: Welds,
        struts: Struts,
        hands: Hands,
        cores: Cores,
        contacts: Contacts,
        global_forces: Forces,
        global_state: State,
    ):
        """Advance every sculpture by some substeps of its frame; `barrier_counts` must be zeros."""
        tile, lane = wp.tid()
        w = tile
        blocks = launch.team
        block = launch.member
        goal = int(0)
        if wp.static(not hosted):
            if tile >= int_at(sculptures.world_block, sculptures.world_block.shape[0] - 1):
                return
            w = wp.lower_bound(sculptures.world_block, tile + 1) - 1
            blocks = int_at(sculptures.world_block, w + 1) - int_at(sculptures.world_block, w)
            block = tile - int_at(sculptures.world_block, w)
        threads = threads_of(blocks, block, lane, wp.static(joint_lanes), wp.static(int(shared)))
        own = ranges_of(w, launch, threads, sculptures, welds, cores, contacts)
        dt = launch.dt
        if launch.walls == 1:
            prepare_contacts(
                threads, own, dt, touch, mesh, balloons, chambers, contacts, global_forces, global_state
            )
        state = global_state
        forces = global_forces
        if wp.static(resident_bytes > 0):
            reserve_shared_memory()
            state = state_in_shared_memory(own, global_state)
            forces = forces_in_shared_memory(own, global_forces)
            copy_state(threads, own, global_state, state)
            block_barrier()
        for k in range(launch.begin, launch.end):
            fraction = float(k + 1) / float(launch.substeps)
            if wp.static(handled):
                if launch.pressing == 1:
                    goal = press_fingers_in(
                        threads, own, w, goal, k, launch, sculptures, mesh, balloons, hands, state
                    )
            stretch_walls(threads, own, mesh, rubber, chambers, forces, state)
            measure_open_rings(threads, own, joints, hands, state)
            if launch.walls == 1:
                press_contacts(threads, own, dt, contacts, forces, state)
            if wp.static(packing):
                press_cores(threads, own, dt, mesh, cores, contacts, state)
            goal = wait_for_blocks(launch, threads, sculptures, w, goal)
            # Gas, in block 0; reactions of contacts, struts and cores meanwhile.
            if threads.block == 0:
                advance_chambers(threads, own, air, dt, fraction, mesh, chambers, joints, state)
            if threads.other >= 0:
                if launch.walls == 1:
                    press_quads_back(threads, own, mesh, contacts, forces, state)
                load_struts(threads, own, joints, struts)
            if wp.static(packing):
                yield_to_cores(threads, own, dt, mesh, cores, contacts, state)
            goal = wait_for_blocks(launch, threads, sculptures, w, goal)
            move_joints(
                launch, threads, own, fraction,
                mesh, balloons, rubber, chambers, joints, welds, struts, hands, contacts, forces, state,
            )  # fmt: skip
            move_vertices(threads, own, dt, mesh, balloons, rubber, chambers, hands, contacts, forces, state)
            if own.welds > 0:
                weld_joints(launch, threads, own, mesh, balloons, joints, welds, hands, state)
            goal = wait_for_blocks(launch, threads, sculptures, w, goal)
        if wp.static(resident_bytes > 0):
            copy_state(threads, own, state, global_state)

    return advance_sculptures


advance_sculptures = substep_kernel(hosted=True)
"""The kernel of a CPU."""
