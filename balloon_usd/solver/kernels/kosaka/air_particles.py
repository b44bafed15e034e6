"""Air as particles that repel each other (Kosaka 2008, 3.2)."""

import warp as wp

from balloon_usd.solver.kernels.arrays.kosaka import Particles
from balloon_usd.solver.kernels.arrays.rows import Constants, Drift
from balloon_usd.solver.kernels.kosaka.drift import drift_at, gain_at, kept_in

NEAREST = wp.constant(1.0e-6)
"""Distance below which two particles count as this far apart (m): the weight has a pole."""


@wp.func
def weight(r: float, re: float) -> float:
    """Return the weight of a particle at a distance r, within its reach re (Kosaka 2008, eq. 3.3)."""
    w = float(0.0)
    if r <= re:
        w = re / wp.max(r, NEAREST) - 1.0
    return w


@wp.func
def repulsion(ri: wp.vec3, rj: wp.vec3, alpha: float, re: float) -> wp.vec3:
    """Return the force (m/s2) of particle j on particle i (Kosaka 2008, eq. 3.4)."""
    d = rj - ri
    return wp.vec3(-alpha * weight(wp.length(d), re) * d)


@wp.kernel
def repel_air(
    air_balloon: wp.array[int],
    constants: wp.array[Constants],
    neighbour_count: wp.array2d[int],
    neighbours: wp.array2d[int],
    air: wp.array[wp.vec3],
    air_push: wp.array[wp.vec3],
):
    """Write the repulsion C_a (m/s2) of every particle by its neighbours (Kosaka 2008, eq. 3.16)."""
    a, lane = wp.tid()
    law = constants[air_balloon[a]]
    here = air[a]
    total = wp.vec3(0.0)
    begin = lane * (neighbours.shape[1] // wp.block_dim())
    for k in range(begin, begin + neighbour_count[a, lane]):
        total += repulsion(here, air[neighbours[a, k]], law.alpha, law.re)
    push = wp.tile_sum(wp.tile(total, preserve_type=True))[0]
    if lane == 0:
        air_push[a] = push


@wp.kernel
def move_air(dt: float, constants: wp.array[Constants], particles: Particles, drifts: wp.array[Drift]):
    """Move every particle by symplectic Euler (Kosaka 2008, eqs. 3.20 and 3.21), its speed limited."""
    a = wp.tid()
    law = constants[particles.air_balloon[a]]
    drift = drifts[particles.air_cluster[a]]
    against = particles.air_speed[a] - drift_at(drift, particles.air[a])
    u = (
        particles.air_speed[a]
        + (
            particles.air_push[a]
            + particles.wall_push[a]
            - law.drag * against
            + gain_at(drift, particles.air[a])
        )
        * dt
    )
    size = wp.length(u)
    if size > law.air_speed:
        u = u * (law.air_speed / size)
    particles.air[a] = kept_in(particles.air[a] + u * dt, drift)
    particles.air_speed[a] = u
