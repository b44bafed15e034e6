"""A step of every vertex without any force."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Rubber
from balloon_usd.solver.kernels.arrays.shared import Balloons, Hands, Mesh, State
from balloon_usd.solver.kernels.physics.motion import step_of_vertex


@wp.kernel
def step_freely(dt: float, mesh: Mesh, balloons: Balloons, rubber: Rubber, hands: Hands, state: State):
    """Move every vertex (m) and write its velocity (m/s)."""
    i = wp.tid()
    p, v = step_of_vertex(i, wp.vec3(0.0), dt, 0, mesh, balloons, rubber, hands, state)
    state.x[i] = p
    state.v[i] = v
