"""The law of the core in kernels of its own: what it writes, and the speed that it gives."""

import warp as wp

from balloon_usd.solver.kernels.physics.core import press_core, yield_to_core


@wp.kernel
def press_cores(
    ring_first: wp.array[int],
    ring_around: wp.array[int],
    ring_cos_sin: wp.array[wp.vec2],
    core_ring: wp.array[int],
    core_next: wp.array[int],
    core_radius: wp.array[float],
    core_row: wp.array[float],
    mass: wp.array[float],
    dt: float,
    ring_radius: wp.array[float],
    x: wp.array[wp.vec3],
    core_order: wp.array[wp.vec3],
    core_push: wp.array[wp.vec3],
    core_thrust: wp.array[wp.vec3],
):
    """Write the forces of the cores of all rings."""
    m, lane = wp.tid()
    press_core(
        m,
        lane,
        wp.block_dim(),
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
        x,
        core_order,
        core_push,
        core_thrust,
    )


@wp.kernel
def yield_to_cores(
    ring_first: wp.array[int],
    ring_around: wp.array[int],
    core_ring: wp.array[int],
    core_next: wp.array[int],
    core_radius: wp.array[float],
    mass: wp.array[float],
    dt: float,
    ring_radius: wp.array[float],
    core_order: wp.array[wp.vec3],
    core_push: wp.array[wp.vec3],
    core_thrust: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
):
    """Give all rings the speed that the forces of their cores give them in a substep."""
    m, lane = wp.tid()
    yield_to_core(
        m,
        lane,
        wp.block_dim(),
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
        v,
    )
