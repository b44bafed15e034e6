"""Single laws of the solver as kernels of their own, for tests that ask one of them alone."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Chambers, Forces, Rubber
from balloon_usd.solver.kernels.arrays.rows import Air
from balloon_usd.solver.kernels.arrays.shared import Mesh, State
from balloon_usd.solver.kernels.device.soa import load_soa, store_soa
from balloon_usd.solver.kernels.physics.gas import advance_gas
from balloon_usd.solver.kernels.physics.membrane import wall_of_quad


@wp.kernel
def quad_forces(mesh: Mesh, rubber: Rubber, chambers: Chambers, forces: Forces, state: State):
    """Write the force (N) of wall and gas on the four corners of every quad."""
    q = wp.tid()
    wall_of_quad(q, wp.vec3(0.0), 0, mesh, rubber, forces, state)
    for k in range(4):
        push = chambers.pressure[mesh.quad_segment[q]] * load_soa(forces.volume_gradient, q, k, 0)
        store_soa(forces.corner_force, q, k, load_soa(forces.corner_force, q, k, 0) + push)


@wp.kernel
def balloon_gas(air: Air, dt: float, fraction: float, chambers: Chambers, state: State):
    """Advance the gas of every balloon."""
    advance_gas(wp.tid(), 0, 1, air, dt, fraction, chambers, state)
