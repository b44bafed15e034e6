"""Springs: the rubber of the thesis's model (Kosaka 2008, 3.1)."""

import warp as wp

from balloon_usd.solver.kernels.arrays.kosaka import Net
from balloon_usd.solver.kernels.arrays.shared import Balloons, Checks, Mesh, State
from balloon_usd.solver.kernels.physics.suspects import check_vertex

SHORTEST = wp.constant(1.0e-9)
"""Length below which a spring has no direction (m)."""


@wp.func
def spring_force(
    x1: wp.vec3, x2: wp.vec3, v1: wp.vec3, v2: wp.vec3, natural: float, ks: float, kd: float
) -> wp.vec3:
    """Return the force (m/s2) of a spring on its second end (Kosaka 2008, eqs. 3.1 and 3.2)."""
    d = x1 - x2
    size = wp.length(d)
    n = d / wp.max(size, SHORTEST)
    return wp.vec3((ks * (size - natural) + kd * wp.dot(v1 - v2, n)) * n)


@wp.func
def calming_force(x1: wp.vec3, x2: wp.vec3, v1: wp.vec3, v2: wp.vec3, calming: float) -> wp.vec3:
    """Return the force (m/s2) that damps what the ends of a spring move across it: eq. 3.1 damps a net only
    along its springs, and the air's push sets it trembling.
    """
    d = x1 - x2
    n = d / wp.max(wp.length(d), SHORTEST)
    apart = v1 - v2
    return wp.vec3(calming * (apart - wp.dot(apart, n) * n))


@wp.kernel
def pull_springs(vertex_balloon: wp.array[int], net: Net, state: State):
    """Write the force (m/s2) of all springs on every vertex (Kosaka 2008, eq. 3.19)."""
    i = wp.tid()
    law = net.constants[vertex_balloon[i]]
    ends = net.spring_ends[i]
    lengths = net.natural[i]
    total = wp.vec3(0.0)
    for k in range(4):
        if ends[k] >= 0:
            total += spring_force(
                state.x[ends[k]], state.x[i], state.v[ends[k]], state.v[i], lengths[k], law.ks, law.kd
            )
            total += calming_force(state.x[ends[k]], state.x[i], state.v[ends[k]], state.v[i], law.calming)
    net.spring_pull[i] = total


HALF_EACH = wp.constant(0.4)
"""Share of a spring's excess length that each end takes back in one substep: half of it in two."""


@wp.kernel
def limit_elongation(
    dt: float,
    x: wp.array[wp.vec3],
    x_next: wp.array[wp.vec3],
    mesh: Mesh,
    net: Net,
    radius_to: wp.array[float],
    v: wp.array[wp.vec3],
):
    """Draw together the ends of springs that are longer than allowed, so that a sudden force cannot tear
    the net (Kosaka 2008, 3.1); both ends move alike, but for those that a hand closes or that are frozen.
    """
    i = wp.tid()
    p = x[i]
    j = mesh.vertex_joint[i]
    if j >= 0:
        if radius_to[j] > 0.0:
            x_next[i] = p
            return
    most = 1.0 + net.constants[mesh.vertex_balloon[i]].elongation_limit
    ends = net.spring_ends[i]
    lengths = net.natural[i]
    shift = wp.vec3(0.0)
    for k in range(4):
        if ends[k] >= 0:
            d = x[ends[k]] - p
            size = wp.length(d)
            excess = size - most * lengths[k]
            if excess > 0.0:
                share = HALF_EACH
                other = mesh.vertex_joint[ends[k]]
                if other >= 0:
                    # The other end does not give way.
                    share = wp.where(radius_to[other] > 0.0, 1.0, HALF_EACH)
                shift += (share * excess / wp.max(size, SHORTEST)) * d
    x_next[i] = p + shift
    v[i] = v[i] + shift / dt


@wp.kernel
def spring_stretch(
    travel_limit: float, mesh: Mesh, balloons: Balloons, net: Net, checks: Checks, state: State
):
    """Write the largest stretch of the springs at every vertex; mark where something may be wrong."""
    i = wp.tid()
    ends = net.spring_ends[i]
    lengths = net.natural[i]
    most = float(0.0)
    for k in range(4):
        if ends[k] >= 0:
            most = wp.max(most, wp.length(state.x[ends[k]] - state.x[i]) / lengths[k])
    checks.stretch[i] = most
    check_vertex(i, most, travel_limit, mesh, balloons, checks, state)
