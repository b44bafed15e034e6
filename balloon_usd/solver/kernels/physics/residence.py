"""Residence in shared memory: when one block has a sculpture for itself, its positions, velocities, forces
and volume gradients stay in the SM's shared memory during a launch: a quarter less time.
"""

from typing import Any

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Forces
from balloon_usd.solver.kernels.arrays.shared import State
from balloon_usd.solver.kernels.device.array_access import put_vec3, vec3_at
from balloon_usd.solver.kernels.device.shared_memory import (
    QUAD_BYTES,
    VERTEX_BYTES,
    shared_soa,
    shared_vectors,
)
from balloon_usd.solver.kernels.physics.work_sharing import Ranges, Threads

VERTEX_SIZE = wp.constant(VERTEX_BYTES)
QUAD_SIZE = wp.constant(QUAD_BYTES)


def shared_memory_of(size: int) -> Any:
    """Return the function that reserves so many bytes of shared memory."""
    numbers = size // 4

    @wp.func
    def reserve_shared_memory():
        """Reserve shared memory for a sculpture."""
        wp.tile_zeros(shape=wp.static(numbers), dtype=float, storage="shared")

    return reserve_shared_memory


@wp.func
def state_in_shared_memory(own: Ranges, state: State):
    """Return the state with positions and velocities in shared memory."""
    vertices = own.vertex_end - own.vertex_begin
    return State(
        shared_vectors(state.x, own.vertex_begin, 0),
        shared_vectors(state.v, own.vertex_begin, VERTEX_SIZE * vertices),
        state.slowness,
        state.reaction,
        state.x_next,
        state.volume,
    )


@wp.func
def forces_in_shared_memory(own: Ranges, forces: Forces):
    """Return the forces with those of the wall in shared memory, behind the state."""
    quads = own.quad_end - own.quad_begin
    begin = 2 * VERTEX_SIZE * (own.vertex_end - own.vertex_begin)
    return Forces(
        shared_soa(forces.corner_force, own.quad_begin, quads, begin),
        shared_soa(forces.volume_gradient, own.quad_begin, quads, begin + QUAD_SIZE * quads),
        forces.pair_corners,
        forces.pair_limits,
        forces.wall_load,
    )


@wp.func
def copy_state(threads: Threads, own: Ranges, source: State, target: State):
    """Copy positions and velocities of a sculpture; one block."""
    for i in range(own.vertex_begin + threads.lane, own.vertex_end, threads.block_size):
        put_vec3(target.x, i, vec3_at(source.x, i))
        put_vec3(target.v, i, vec3_at(source.v, i))
