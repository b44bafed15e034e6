"""Single laws of the solver as kernels of their own, for tests that ask one of them alone."""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import Air, CurveSegment, Law
from balloon_usd.solver.kernels.device.soa import load_soa, store_soa
from balloon_usd.solver.kernels.physics.gas import advance_gas
from balloon_usd.solver.kernels.physics.membrane import wall_of_quad


@wp.kernel
def quad_forces(
    quads: wp.array[wp.vec4i],
    quad_segment: wp.array[int],
    quad_law: wp.array[int],
    rest_inverse: wp.array[wp.mat22],
    hourglass: wp.array[wp.vec4],
    rubber_volume: wp.array[float],
    laws: wp.array[Law],
    curves: wp.array[CurveSegment],
    pressure: wp.array[float],
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
    softening_rate: wp.array[float],
    peak_energy: wp.array[float],
    corner_force: wp.array2d[float],
    volume_gradient: wp.array2d[float],
):
    """Write the force (N) of wall and gas on the four corners of every quad."""
    q = wp.tid()
    wall_of_quad(
        q,
        quads,
        quad_law,
        rest_inverse,
        hourglass,
        rubber_volume,
        laws,
        curves,
        x,
        v,
        wp.vec3(0.0),
        softening_rate,
        peak_energy,
        corner_force,
        volume_gradient,
    )
    for k in range(4):
        push = pressure[quad_segment[q]] * load_soa(volume_gradient, q, k)
        store_soa(corner_force, q, k, load_soa(corner_force, q, k) + push)


@wp.kernel
def balloon_gas(
    balloon_segment: wp.array[int],
    balloon_segment_end: wp.array[int],
    chamber_first: wp.array[int],
    chamber_last: wp.array[int],
    end_joint: wp.array[int],
    inlet: wp.array[int],
    air: Air,
    dt: float,
    fraction: float,
    blowing: wp.array[int],
    open_from: wp.array[float],
    open_to: wp.array[float],
    pump_flow: wp.array[float],
    pump_limit: wp.array[float],
    pump_goal: wp.array[wp.float64],
    volume: wp.array[float],
    chamber_volume: wp.array[float],
    flow: wp.array[wp.float64],
    amount: wp.array[wp.float64],
    pressure: wp.array[float],
):
    """Advance the gas of every balloon."""
    advance_gas(
        wp.tid(),
        0,
        1,
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
