"""Single laws of the solver as kernels of their own, for tests that ask one of them alone."""

import warp as wp

from balloon_usd.solver.kernels.gas import Air, advance_gas
from balloon_usd.solver.kernels.membrane import quad_force
from balloon_usd.solver.kernels.rubber import Law


@wp.kernel
def quad_forces(
    quads: wp.array[wp.vec4i],
    quad_segment: wp.array[int],
    quad_law: wp.array[int],
    to_rest: wp.array[wp.mat22],
    hourglass: wp.array[wp.vec4],
    rubber_volume: wp.array[float],
    laws: wp.array[Law],
    pressure: wp.array[float],
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
    softening_rate: wp.array[float],
    peak_energy: wp.array[float],
    corner_force: wp.array2d[wp.vec3],
):
    """Write the force (N) of wall and gas on the four corners of every quad."""
    quad_force(
        wp.tid(),
        quads,
        quad_segment,
        quad_law,
        to_rest,
        hourglass,
        rubber_volume,
        laws,
        pressure,
        x,
        v,
        softening_rate,
        peak_energy,
        corner_force,
    )


@wp.kernel
def balloon_gas(
    balloon_segment: wp.array[int],
    balloon_segment_end: wp.array[int],
    end_joint: wp.array[int],
    inlet: wp.array[int],
    air: Air,
    dt: float,
    fraction: float,
    open_from: wp.array[float],
    open_to: wp.array[float],
    pump_flow: wp.array[float],
    pump_limit: wp.array[float],
    pump_goal: wp.array[wp.float64],
    volume: wp.array[float],
    room: wp.array[float],
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
        end_joint,
        inlet,
        air,
        dt,
        fraction,
        open_from,
        open_to,
        pump_flow,
        pump_limit,
        pump_goal,
        volume,
        room,
        flow,
        amount,
        pressure,
    )
