"""The core of a wound neck: the inside of a wall meets itself there and packs, and a neck is neither thinner
nor shorter than its rubber.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Cores
from balloon_usd.solver.kernels.arrays.shared import Contacts, Mesh, State
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, put_vec3, vec2_at
from balloon_usd.solver.kernels.device.coherent_load import coherent_vec3
from balloon_usd.solver.kernels.device.warp_reduce import warp_sum, warp_sum3
from balloon_usd.solver.kernels.physics.joints import nearest_axes

THIN = wp.constant(4.0)
"""Radius below which a ring is watched, in radii of its core: twice that at which anything acts."""
STIFF = wp.constant(0.25)
"""Stiffness of a core at a vertex, in vertex masses per squared time step."""
LEAST = wp.constant(0.5)
"""Least distance between rings that counts, in unstressed ones: where a wall closes in steeply it is a
funnel, not packed yet.
"""
LOOSE = wp.constant(2.0)
"""Radius below which packed rubber begins to keep the order round its ring, in radii of its core."""


@wp.func
def thin(m: int, core_ring: wp.array[int], core_radius: wp.array[float], ring_radius: wp.array[float]):
    """Return 1 where a ring is so thin that its inside may soon meet itself."""
    if float_at(ring_radius, int_at(core_ring, m)) < THIN * float_at(core_radius, m):
        return 1
    return 0


@wp.func
def thin_between(m: int, cores: Cores, contacts: Contacts):
    """Return 1 where a ring or the next of its balloon is thin; there is no ring before the first."""
    if m < 0:
        return 0
    if int_at(cores.core_next, m) == 0:
        return 0
    return wp.max(
        thin(m, cores.core_ring, cores.core_radius, contacts.ring_radius),
        thin(m + 1, cores.core_ring, cores.core_radius, contacts.ring_radius),
    )


@wp.func
def ring_mean(first: int, n: int, lane: int, lanes: int, x: wp.array[wp.vec3], shared: int):
    """Return the middle (m) of a ring's vertices."""
    origin = coherent_vec3(x, first, shared)
    c = wp.vec3(0.0)
    for k in range(lane, n, lanes):
        c += coherent_vec3(x, first + k, shared) - origin
    return origin + warp_sum3(c, lanes) / float(n)


@wp.func
def keep_order(
    first: int,
    n: int,
    middle: wp.vec3,
    radius: float,
    stiffness: float,
    lane: int,
    lanes: int,
    ring_cos_sin: wp.array[wp.vec2],
    x: wp.array[wp.vec3],
    core_order: wp.array[wp.vec3],
    shared: int,
):
    """Write the forces (N) that draw a ring to the nearest regular polygon of its own size, more the more its
    rubber is packed: what is packed passes nothing beside it.

    `radius`: of its core, m; `stiffness`: N/m.
    """
    a = wp.vec3(0.0)
    b = wp.vec3(0.0)
    for k in range(lane, n, lanes):
        arm = coherent_vec3(x, first + k, shared) - middle
        at = vec2_at(ring_cos_sin, first + k)
        a += at[0] * arm
        b += at[1] * arm
    a = warp_sum3(a, lanes)
    b = warp_sum3(b, lanes)
    # In its plane it is turned so that the forces have no torque at all.
    axes = nearest_axes(a, b)
    p = axes * wp.vec2(1.0, 0.0)
    q = axes * wp.vec2(0.0, 1.0)
    along = (wp.dot(p, a) + wp.dot(q, b)) / float(n)
    across = (wp.dot(q, a) - wp.dot(p, b)) / float(n)
    u = along * p + across * q
    w = along * q - across * p
    pull = stiffness * wp.clamp(LOOSE - wp.length(u) / radius, 0.0, 1.0)
    for k in range(lane, n, lanes):
        i = first + k
        at = vec2_at(ring_cos_sin, i)
        put_vec3(core_order, i, pull * (at[0] * u + at[1] * w - (coherent_vec3(x, i, shared) - middle)))


@wp.func
def press_core(
    m: int,
    lane: int,
    lanes: int,
    dt: float,
    shared: int,
    mesh: Mesh,
    cores: Cores,
    contacts: Contacts,
    state: State,
):
    """Write the forces (N) that keep the order of a ring, those of the core between it and the next ring on
    the middles between their vertices, and the force (N) on every vertex of the next that keeps them apart.

    The nearer two rings are, the thicker a core the rubber between them fills. Turned against each other they
    are thinnest halfway, where their wall would pass through itself after half a turn.
    """
    mine = thin(m, cores.core_ring, cores.core_radius, contacts.ring_radius)
    between = thin_between(m, cores, contacts)
    if wp.max(mine, between) == 0:
        return
    ring = int_at(cores.core_ring, m)
    n = int_at(mesh.ring_around, ring)
    first = int_at(mesh.ring_first, ring)
    c = ring_mean(first, n, lane, lanes, state.x, shared)
    stiffness = STIFF * float_at(mesh.mass, first) / (dt * dt)
    if mine == 1:
        keep_order(
            first,
            n,
            c,
            float_at(cores.core_radius, m),
            stiffness,
            lane,
            lanes,
            mesh.ring_cos_sin,
            state.x,
            cores.core_order,
            shared,
        )
    if between == 1:
        beyond = int_at(mesh.ring_first, int_at(cores.core_ring, m + 1))
        row = float_at(cores.core_row, m)
        stiffness = wp.min(stiffness, STIFF * float_at(mesh.mass, beyond) / (dt * dt))
        d = ring_mean(beyond, n, lane, lanes, state.x, shared)
        gap = wp.max(wp.length(d - c), LEAST * row)
        radius = float_at(cores.core_radius, m) * wp.sqrt(row / gap)
        pressed = float(0.0)
        for k in range(lane, n, lanes):
            arm = 0.5 * (
                (coherent_vec3(state.x, first + k, shared) - c)
                + (coherent_vec3(state.x, beyond + k, shared) - d)
            )
            far = wp.max(wp.length(arm), 1.0e-9)
            push = stiffness * wp.max(radius - far, 0.0)
            put_vec3(cores.core_push, first + k, arm * (push / far))
            pressed += push
        # By the work of a core that keeps its volume: a hundredth shorter is half a hundredth thicker.
        thrust = 0.5 * radius / gap * warp_sum(pressed) / float(n)
        if lane == 0:
            put_vec3(cores.core_thrust, m, (thrust / gap) * (d - c))


@wp.func
def force_of_cores(
    i: int,
    before: int,
    keeps: int,
    off_next: int,
    off_last: int,
    core_order: wp.array[wp.vec3],
    core_push: wp.array[wp.vec3],
    shared: int,
):
    """Return the force (N) of cores on a vertex: half of those on the middles between it and its neighbours
    on the rings beside its own, of which `before` is that on the last ring.
    """
    f = wp.vec3(0.0)
    if keeps == 1:
        f += coherent_vec3(core_order, i, shared)
    if off_next == 1:
        f += 0.5 * coherent_vec3(core_push, i, shared)
    if off_last == 1:
        f += 0.5 * coherent_vec3(core_push, before, shared)
    return f


@wp.func
def yield_to_core(
    m: int,
    lane: int,
    lanes: int,
    dt: float,
    shared: int,
    mesh: Mesh,
    cores: Cores,
    contacts: Contacts,
    state: State,
):
    """Add to the velocity (m/s) of a ring's vertices what the cores in it and on both sides give them.

    All add up to nothing and have no torque: those on a ring are along arms from its middle, less their mean,
    and the thrust of a core is along the line between two middles.
    """
    keeps = thin(m, cores.core_ring, cores.core_radius, contacts.ring_radius)
    off_next = thin_between(m, cores, contacts)
    off_last = thin_between(m - 1, cores, contacts)
    if keeps + off_next + off_last == 0:
        return
    ring = int_at(cores.core_ring, m)
    n = int_at(mesh.ring_around, ring)
    first = int_at(mesh.ring_first, ring)
    last = first
    thrust = wp.vec3(0.0)
    if off_next == 1:
        thrust -= coherent_vec3(cores.core_thrust, m, shared)
    if off_last == 1:
        thrust += coherent_vec3(cores.core_thrust, m - 1, shared)
        last = int_at(mesh.ring_first, int_at(cores.core_ring, m - 1))
    total = wp.vec3(0.0)
    for k in range(lane, n, lanes):
        total += force_of_cores(
            first + k, last + k, keeps, off_next, off_last, cores.core_order, cores.core_push, shared
        )
    thrust -= warp_sum3(total, lanes) / float(n)
    for k in range(lane, n, lanes):
        i = first + k
        f = force_of_cores(i, last + k, keeps, off_next, off_last, cores.core_order, cores.core_push, shared)
        put_vec3(state.v, i, coherent_vec3(state.v, i, shared) + (f + thrust) * (dt / float_at(mesh.mass, i)))
