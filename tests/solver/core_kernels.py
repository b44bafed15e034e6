"""The law of the core in kernels of its own: what it writes, and the speed that it gives."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Cores
from balloon_usd.solver.kernels.arrays.shared import Contacts, Mesh, State
from balloon_usd.solver.kernels.physics.core import press_core, yield_to_core


@wp.kernel
def press_cores(dt: float, mesh: Mesh, cores: Cores, contacts: Contacts, state: State):
    """Write the forces of the cores of all rings."""
    m, lane = wp.tid()
    press_core(m, lane, wp.block_dim(), dt, 0, mesh, cores, contacts, state)


@wp.kernel
def yield_to_cores(dt: float, mesh: Mesh, cores: Cores, contacts: Contacts, state: State):
    """Give all rings the speed that the forces of their cores give them in a substep."""
    m, lane = wp.tid()
    yield_to_core(m, lane, wp.block_dim(), dt, 0, mesh, cores, contacts, state)
