"""Reactions of walls that would cross: forces that grow until walls stay apart by themselves (multipliers, as
in augmented Lagrangians).

Contact presses only walls whose normals oppose, so not what is folded up beside a neck; without a reaction it
is moved back at every search, and springs forth again.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Crossings
from balloon_usd.solver.kernels.arrays.shared import Hands, Mesh, State
from balloon_usd.solver.kernels.device.array_access import float_at, int_at
from balloon_usd.solver.kernels.device.atomic import add_vec3i
from balloon_usd.solver.kernels.physics.piercing_pair import moved, vertex_of_pair, weight_in_pair

PER_MOMENT = wp.constant(1.0e12)
"""Integers to 1 kg m in sums of mass by way: added as integers they do not depend on the order of threads."""
STIFFNESS = wp.constant(1.0e6)
"""How much larger the push of a pair is each time that it would cross, per way on which it came nearer and
per mass, 1/s2. With 2e5 a crown of 54 bubbles needs twice as many rounds.
"""
MOST_NEARING = wp.constant(2.0e-5)
"""Way that counts at most, m: what hits at speed is not thrown back. With 0.1 mm ears roll on after the hands
have let go.
"""
KEPT = wp.constant(0.95)
"""Share of a reaction that is left each time that walls are kept apart: with 0.98 it bears 1 % of the push of
two balls when these are long at rest.
"""
MOST_REACTION = wp.constant(3000.0)
"""Largest reaction per mass, m/s2."""
LEAST_REACTION = wp.constant(1.0)
"""Reaction per mass below which there is none, m/s2."""


@wp.func
def push_apart(
    ends: wp.vec3i,
    other: wp.vec3i,
    share: float,
    on_face: wp.vec3,
    normal: wp.vec3,
    mesh: Mesh,
    crossings: Crossings,
):
    """Add to what an edge and a triangle push each other apart (kg m), where they touch and along a unit
    normal: the same on both, so that no momentum comes of it.

    `share`, `on_face`: where they touch, as a share of the edge and in barycentric coordinates.
    """
    along = wp.clamp(share, 0.0, 1.0)
    inside = wp.max(on_face, wp.vec3(0.0))
    inside /= inside[0] + inside[1] + inside[2]
    nearing = float(0.0)
    mobility = float(0.0)
    for k in range(5):
        i = vertex_of_pair(k, ends, other)
        weight = weight_in_pair(k, along, inside)
        nearing += weight * wp.dot(moved(i, crossings), normal)
        mobility += weight * weight / float_at(mesh.mass, i)
    push = -PER_MOMENT * wp.clamp(nearing, -MOST_NEARING, MOST_NEARING) / mobility
    for k in range(5):
        own = weight_in_pair(k, along, inside) * push * normal
        whole = wp.vec3i(int(wp.round(own[0])), int(wp.round(own[1])), int(wp.round(own[2])))
        add_vec3i(crossings.pushed, vertex_of_pair(k, ends, other), whole)


@wp.func
def reaction_after(i: int, seconds: float, mesh: Mesh, hands: Hands, crossings: Crossings, state: State):
    """Return the force (N) that other walls have on a vertex from now on: what is left of the last, turned
    with what hands turn, and more where it would have crossed.

    `seconds`: since the last.
    """
    reaction = KEPT * state.reaction[i]
    spin = int_at(hands.vertex_spin, i)
    if spin > 0:
        turn = hands.spins[spin - 1]
        reaction = wp.quat_rotate(wp.quat_from_axis_angle(turn.axis, turn.rate * seconds), reaction)
    sums = crossings.pushed[i]
    reaction += (STIFFNESS / PER_MOMENT) * wp.vec3(float(sums[0]), float(sums[1]), float(sums[2]))
    mass = float_at(mesh.mass, i)
    size = wp.length(reaction)
    if size < LEAST_REACTION * mass:
        return wp.vec3(0.0)
    return reaction * wp.min(MOST_REACTION * mass / size, 1.0)
