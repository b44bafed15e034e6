"""An edge that pierces a wall, and two answers to it: both go on as one, or both are led apart."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Crossings
from balloon_usd.solver.kernels.arrays.shared import Contacts, Mesh
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, vec3_at
from balloon_usd.solver.kernels.device.atomic import add_int, add_vec4i
from balloon_usd.solver.kernels.physics.piercing_pair import moved, vertex_of_pair
from balloon_usd.solver.kernels.physics.reaction import push_apart

FLATTEST = wp.constant(0.1)
"""Least sine of the angle between an edge and a wall that it pierces: a flatter one is led as if it had this,
else it would be led without limit.
"""
LONGER = wp.constant(0.01)
"""How much longer an edge and wider a triangle is taken to be, in themselves: so what does not pierce here
does not either where it is counted exactly.
"""
SHORTER = wp.constant(1.0 / 80.0)
"""How much of that is left out in every round of motions that are shared: where hands hold a wall as near as
this, rounds never ended (7 of 8 sculptures put back had only such edges).
"""
SHORTER_PUT_BACK = wp.constant(1.0 / 20.0)
"""The same where a sculpture was put back and is led apart."""
LEAST_LONGER = wp.constant(0.1)
"""Least share of it."""
NEARER = wp.constant(0.98)
"""How near an edge that was as near as this already may come to piercing in one go, in how near it was: what
stays where it was is kept apart at once.
"""
SLIDING_ROUNDS = wp.constant(16)
"""Rounds in which an edge and a triangle that it would pierce may slide on each other: after them they move
as one. So folds come loose: three ears in a row take half the time, and keep more of their gas.
"""
LEAST_RISE = wp.constant(1.0e-20)
"""Height of an edge's one end over the other, times an area, from which on it may pierce, m3."""
PER_UNIT = wp.constant(65536.0)
"""Integers to 1 in sums of ways: added as integers they do not depend on the order of threads."""
PER_METRE = wp.constant(1.0e8)
"""Integers to 1 m in sums of motions."""


@wp.func
def is_corner(i: int, quad: wp.vec4i):
    """Return whether a vertex is a corner of a quad."""
    return i == quad[0] or i == quad[1] or i == quad[2] or i == quad[3]


@wp.func
def lead_back(i: int, share: float, way: wp.vec3, crossings: Crossings):
    """Add to the way of a vertex, by its share in what is led."""
    whole = wp.vec4i(0)
    for k in range(3):
        whole[k] = int(wp.round(PER_UNIT * share * way[k]))
    whole[3] = int(wp.round(PER_UNIT * wp.abs(share)))
    add_vec4i(crossings.way_back, i, whole)


@wp.func
def counts(ends: wp.vec3i, neck: int, mesh: Mesh):
    """Return whether an edge may not pierce a quad beside which it does not end: it is not folded up in its
    neck.

    `neck`: of the quad.
    """
    return neck < 0 or int_at(mesh.vertex_neck, ends[0]) != neck or int_at(mesh.vertex_neck, ends[1]) != neck


@wp.func
def shares_of_face(place: wp.vec3, a: wp.vec3, b: wp.vec3, c: wp.vec3, across: wp.vec3):
    """Return the barycentric coordinates of a point in the plane of a triangle; `across`: its normal, twice
    its area long.
    """
    size = wp.max(wp.dot(across, across), 1.0e-30)
    first = wp.dot(wp.cross(b - place, c - place), across) / size
    second = wp.dot(wp.cross(c - place, a - place), across) / size
    return wp.vec3(first, second, 1.0 - first - second)


@wp.func
def share_of_edge(below: float, above: float):
    """Return at which share of an edge its line goes through a plane, by the heights of its two ends."""
    rise = below - above
    return below / wp.where(wp.abs(rise) < LEAST_RISE, LEAST_RISE, rise)


@wp.func
def where_pierced(p: wp.vec3, q: wp.vec3, a: wp.vec3, b: wp.vec3, c: wp.vec3):
    """Return where the line from `p` to `q` goes through the plane of a triangle: its share of the way, and
    the barycentric coordinates there.
    """
    across = wp.cross(b - a, c - a)
    share = share_of_edge(wp.dot(across, p - a), wp.dot(across, q - a))
    return share, shares_of_face(p + share * (q - p), a, b, c, across)


@wp.func
def beside_face(share: float, on_face: wp.vec3):
    """Return how far an edge goes beside a triangle, in lengths of either, below 0 through it, from where its
    line is pierced.
    """
    return wp.max(wp.max(-share, share - 1.0), -wp.min(on_face))


@wp.func
def normal_between(p: wp.vec3, q: wp.vec3, a: wp.vec3, b: wp.vec3, c: wp.vec3):
    """Return the unit normal of where an edge from `p` to `q` would touch a triangle that it goes beside:
    that of the face under its nearer end, or that of it and the edge of the triangle that it would cross.
    """
    share, on_face = where_pierced(p, q, a, b, c)
    normal = wp.normalize(wp.cross(b - a, c - a))
    least = wp.min(on_face)
    if wp.max(-share, share - 1.0) < -least:
        side = b - a
        if on_face[0] == least:
            side = c - b
        elif on_face[1] == least:
            side = a - c
        edges = wp.cross(wp.normalize(q - p), wp.normalize(side))
        if wp.length(edges) > FLATTEST:
            normal = wp.normalize(edges)
    return normal


@wp.func
def add_motion(i: int, motion: wp.vec3, crossings: Crossings):
    """Add to the motions (m) that a vertex shares."""
    way = PER_METRE * motion
    whole = wp.vec4i(int(wp.round(way[0])), int(wp.round(way[1])), int(wp.round(way[2])), 1)
    add_vec4i(crossings.way_back, i, whole)


@wp.func
def share_motion(
    ends: wp.vec3i,
    other: wp.vec3i,
    share: float,
    on_face: wp.vec3,
    world: int,
    mesh: Mesh,
    contacts: Contacts,
    crossings: Crossings,
):
    """Count an edge that pierces a triangle, and let both move as one, first only along the normal of where
    they would touch, on which they also push from now on; where one crossed before already they are only
    counted apart.

    `share`, `on_face`: where, as of `where_pierced`.
    """
    before = int(0)
    for k in range(5):
        before += int_at(contacts.crossed, vertex_of_pair(k, ends, other))
    if before > 0:
        add_int(crossings.crossed_count, world, 1)
        return
    add_int(crossings.pierced_count, world, 1)
    # The mean of their momenta: else walls that are kept apart turn about each other by themselves.
    mass = float(0.0)
    mean = wp.vec3(0.0)
    for k in range(5):
        i = vertex_of_pair(k, ends, other)
        m = float_at(mesh.mass, i)
        mass += m
        mean += m * moved(i, crossings)
    mean /= mass
    slides = int_at(crossings.untangling_round, world) < SLIDING_ROUNDS
    normal = wp.vec3(0.0)
    if slides:
        normal = normal_between(
            vec3_at(crossings.x_safe, ends[0]),
            vec3_at(crossings.x_safe, ends[1]),
            vec3_at(crossings.x_safe, other[0]),
            vec3_at(crossings.x_safe, other[1]),
            vec3_at(crossings.x_safe, other[2]),
        )
    if int_at(crossings.untangling_round, world) == 0:
        push_apart(ends, other, share, on_face, normal, mesh, crossings)
    for k in range(5):
        i = vertex_of_pair(k, ends, other)
        motion = mean
        if slides:
            motion = moved(i, crossings)
            motion += wp.dot(mean - motion, normal) * normal
        add_motion(i, motion, crossings)


@wp.func
def nearest_allowed(ends: wp.vec3i, other: wp.vec3i, together: int, world: int, crossings: Crossings):
    """Return how far beside a triangle an edge has to go, in this round."""
    done = float(int_at(crossings.untangling_round, world))
    shorter = wp.where(together == 1, SHORTER, SHORTER_PUT_BACK)
    nearest = LONGER * wp.max(1.0 - shorter * done, LEAST_LONGER)
    if together == 1:
        share, on_face = where_pierced(
            vec3_at(crossings.x_safe, ends[0]),
            vec3_at(crossings.x_safe, ends[1]),
            vec3_at(crossings.x_safe, other[0]),
            vec3_at(crossings.x_safe, other[1]),
            vec3_at(crossings.x_safe, other[2]),
        )
        before = beside_face(share, on_face)
        if before > 0.0:
            nearest = wp.min(nearest, NEARER * before)
    return nearest


@wp.func
def goes_through(
    p: wp.vec3,
    q: wp.vec3,
    below: float,
    above: float,
    a: wp.vec3,
    b: wp.vec3,
    c: wp.vec3,
    across: wp.vec3,
):
    """Return whether an edge from `p` to `q`, a little longer than it is, goes through a triangle that is a
    little wider.

    `below`, `above`: heights of its ends above the triangle's plane, times twice its area; `across`: normal
    of the triangle, twice its area long.
    """
    share = share_of_edge(below, above)
    # What is gone of a torn wall has no area: nothing goes through it.
    if share < -LONGER or share > 1.0 + LONGER or wp.dot(across, across) == 0.0:
        return False
    return wp.min(shares_of_face(p + share * (q - p), a, b, c, across)) >= -LONGER


@wp.func
def answer_edge(
    ends: wp.vec3i,
    other: wp.vec3i,
    neck: int,
    together: int,
    world: int,
    mesh: Mesh,
    contacts: Contacts,
    crossings: Crossings,
):
    """Count an edge that pierces a triangle, and add to the ways of both how the contour in one face of the
    edge becomes shorter (Volino & Magnenat-Thalmann 2006), or the mean of their motions.

    `ends`: of the edge, and the third corner of its face; `other`: corners of the triangle; `neck`: in which
    that lies; `together`: 1 for their motions.
    """
    if not counts(ends, neck, mesh):
        return
    p = vec3_at(crossings.x_apart, ends[0])
    q = vec3_at(crossings.x_apart, ends[1])
    inward = vec3_at(crossings.x_apart, ends[2])
    a = vec3_at(crossings.x_apart, other[0])
    b = vec3_at(crossings.x_apart, other[1])
    c = vec3_at(crossings.x_apart, other[2])
    share, on_face = where_pierced(p, q, a, b, c)
    if together == 1 or int_at(crossings.put_back, world) > 0:
        if beside_face(share, on_face) > nearest_allowed(ends, other, together, world, crossings):
            return
    if together == 1:
        share_motion(ends, other, share, on_face, world, mesh, contacts, crossings)
        return
    add_int(crossings.pierced_count, world, 1)
    across = wp.cross(b - a, c - a)
    normal = across / wp.sqrt(wp.max(wp.dot(across, across), 1.0e-30))
    along = wp.normalize(q - p)
    into = inward - p
    into = into - wp.dot(into, along) * along
    # The contour runs where both faces are, from the edge into its own.
    contour = wp.normalize(wp.cross(normal, wp.cross(along, into)))
    contour = contour * wp.sign(wp.dot(contour, into))
    steep = wp.dot(along, normal)
    steep = wp.sign(steep) * wp.max(wp.abs(steep), FLATTEST)
    way = wp.normalize(contour - (wp.dot(along, contour) / steep) * normal)
    lead_back(ends[0], 1.0 - share, way, crossings)
    lead_back(ends[1], share, way, crossings)
    lead_back(other[0], -on_face[0], way, crossings)
    lead_back(other[1], -on_face[1], way, crossings)
    lead_back(other[2], -on_face[2], way, crossings)
