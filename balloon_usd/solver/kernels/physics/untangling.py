"""Walls that have gone through each other are led back: intersection contours are made shorter, which needs
neither insides nor outsides (Volino & Magnenat-Thalmann 2006, "Resolving surface collisions through
intersection contour minimization").
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.shared import (
    Balloons,
    Contacts,
    Hands,
    Mesh,
    Sculptures,
    State,
    Welds,
)
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, vec3_at, vec4i_at
from balloon_usd.solver.kernels.device.warp_reduce import lowest_bit, warp_ballot

FLATTEST = wp.constant(0.1)
"""Least sine of the angle between an edge and a wall that it pierces: a flatter one is led as if it had this,
else it would be led without limit.
"""
PER_UNIT = wp.constant(65536.0)
"""Integers to 1 in sums of ways back: added as integers they do not depend on the order of threads."""
UNDECIDED = wp.constant(1.0e-3)
"""Sum of ways, for a share of 1, below which they cancel: so a vertex goes less than a whole step."""


@wp.func
def is_corner(i: int, quad: wp.vec4i):
    """Return whether a vertex is a corner of a quad."""
    return i == quad[0] or i == quad[1] or i == quad[2] or i == quad[3]


@wp.func
def share_corner(c: wp.vec4i, d: wp.vec4i):
    """Return whether two quads have a vertex in common."""
    return is_corner(c[0], d) or is_corner(c[1], d) or is_corner(c[2], d) or is_corner(c[3], d)


@wp.func
def lead_back(i: int, share: float, way: wp.vec3, contacts: Contacts):
    """Add to the way of a vertex, by its share in what is led."""
    whole = wp.vec4i(0)
    for k in range(3):
        whole[k] = int(wp.round(PER_UNIT * share * way[k]))
    whole[3] = int(wp.round(PER_UNIT * wp.abs(share)))
    wp.atomic_add(contacts.way_back, i, whole)


@wp.func
def lead_edge_back(
    ends: wp.vec2i,
    p: wp.vec3,
    q: wp.vec3,
    inward: wp.vec3,
    below: float,
    above: float,
    other: wp.vec3i,
    a: wp.vec3,
    b: wp.vec3,
    c: wp.vec3,
    contacts: Contacts,
):
    """Add to the ways of an edge and a triangle how the contour in one face of the edge becomes shorter, if
    the edge pierces the triangle.

    `p`, `q`: ends of the edge, m; `inward`: third corner of its face, m; `below`, `above`: heights of the
    ends above the triangle's plane, times twice its area; `a`, `b`, `c`: corners of the triangle, m.
    """
    if (below < 0.0) == (above < 0.0):
        return
    share = below / (below - above)
    place = p + share * (q - p)
    across = wp.cross(b - a, c - a)
    size = wp.dot(across, across)
    first = wp.dot(wp.cross(b - place, c - place), across) / size
    second = wp.dot(wp.cross(c - place, a - place), across) / size
    third = 1.0 - first - second
    if first < 0.0 or second < 0.0 or third < 0.0:
        return
    normal = across / wp.sqrt(size)
    along = wp.normalize(q - p)
    into = inward - p
    into = into - wp.dot(into, along) * along
    # The contour runs where both faces are, from the edge into its own.
    contour = wp.normalize(wp.cross(normal, wp.cross(along, into)))
    contour = contour * wp.sign(wp.dot(contour, into))
    rise = wp.dot(along, normal)
    rise = wp.sign(rise) * wp.max(wp.abs(rise), FLATTEST)
    way = wp.normalize(contour - (wp.dot(along, contour) / rise) * normal)
    lead_back(ends[0], 1.0 - share, way, contacts)
    lead_back(ends[1], share, way, contacts)
    lead_back(other[0], -first, way, contacts)
    lead_back(other[1], -second, way, contacts)
    lead_back(other[2], -third, way, contacts)


@wp.func
def lead_triangle_back(
    own: wp.vec3i,
    p0: wp.vec3,
    p1: wp.vec3,
    p2: wp.vec3,
    other: wp.vec3i,
    a: wp.vec3,
    b: wp.vec3,
    c: wp.vec3,
    contacts: Contacts,
):
    """Add to the ways of two triangles how the contours at the edges of the first become shorter."""
    across = wp.cross(b - a, c - a)
    h0 = wp.dot(across, p0 - a)
    h1 = wp.dot(across, p1 - a)
    h2 = wp.dot(across, p2 - a)
    lead_edge_back(wp.vec2i(own[0], own[1]), p0, p1, p2, h0, h1, other, a, b, c, contacts)
    lead_edge_back(wp.vec2i(own[1], own[2]), p1, p2, p0, h1, h2, other, a, b, c, contacts)
    lead_edge_back(wp.vec2i(own[2], own[0]), p2, p0, p1, h2, h0, other, a, b, c, contacts)


@wp.func
def beyond(across: wp.vec3, a: wp.vec3, x0: wp.vec3, x1: wp.vec3, x2: wp.vec3, x3: wp.vec3):
    """Return whether four points are on one side of a plane through `a`."""
    h0 = wp.dot(across, x0 - a)
    h1 = wp.dot(across, x1 - a)
    h2 = wp.dot(across, x2 - a)
    h3 = wp.dot(across, x3 - a)
    low = wp.min(wp.min(h0, h1), wp.min(h2, h3))
    high = wp.max(wp.max(h0, h1), wp.max(h2, h3))
    return low > 0.0 or high < 0.0


@wp.func
def lead_quad_back(c: wp.vec4i, d: wp.vec4i, contacts: Contacts, x: wp.array[wp.vec3]):
    """Add to the ways of two quads how the contours at the edges of the first, diagonal included, become
    shorter.
    """
    p0 = vec3_at(x, c[0])
    p1 = vec3_at(x, c[1])
    p2 = vec3_at(x, c[2])
    p3 = vec3_at(x, c[3])
    a = vec3_at(x, d[0])
    for half in range(2):
        k = half + 1
        other = wp.vec3i(d[0], d[k], d[k + 1])
        b = vec3_at(x, other[1])
        e = vec3_at(x, other[2])
        if not beyond(wp.cross(b - a, e - a), a, p0, p1, p2, p3):
            lead_triangle_back(wp.vec3i(c[0], c[1], c[2]), p0, p1, p2, other, a, b, e, contacts)
            lead_triangle_back(wp.vec3i(c[0], c[2], c[3]), p0, p2, p3, other, a, b, e, contacts)


@wp.func
def boxes_meet(chunk: int, other: int, contacts: Contacts):
    """Return 1 where the bounding boxes of two chunks overlap."""
    low = vec3_at(contacts.chunk_low, chunk)
    high = vec3_at(contacts.chunk_high, chunk)
    other_low = vec3_at(contacts.chunk_low, other)
    other_high = vec3_at(contacts.chunk_high, other)
    found = int(0)
    # The first axis already culls most chunks.
    if other_low[0] < high[0] and other_high[0] > low[0]:
        if (
            other_low[1] < high[1]
            and other_high[1] > low[1]
            and other_low[2] < high[2]
            and other_high[2] > low[2]
        ):
            found = 1
    return found


@wp.func
def joint_of_neck(q: int, mesh: Mesh, welds: Welds):
    """Return the joint in whose neck a quad lies, the same for all of a weld; -1 for none."""
    joint = int_at(mesh.quad_neck, q)
    if joint >= 0:
        joint = int_at(welds.joint_leader, joint)
    return joint


@wp.func
def near_quads(q: int, other: int, mesh: Mesh, contacts: Contacts):
    """Return the bits of those quads of a chunk that are near a quad."""
    middle = vec3_at(contacts.quad_middle, q)
    radius = float_at(contacts.quad_radius, q)
    off = wp.max(
        wp.max(vec3_at(contacts.chunk_low, other) - middle, middle - vec3_at(contacts.chunk_high, other)),
        wp.vec3(0.0),
    )
    bits = int(0)
    if wp.dot(off, off) < radius * radius:
        base = int_at(mesh.chunk_quad, other)
        for r in range(base, int_at(mesh.chunk_quad, other + 1)):
            d = middle - vec3_at(contacts.quad_middle, r)
            near = radius + float_at(contacts.quad_radius, r)
            if wp.dot(d, d) < near * near:
                bits |= 1 << (r - base)
    return bits


@wp.func
def lead_chunk_back(q: int, other: int, mesh: Mesh, welds: Welds, contacts: Contacts, state: State):
    """Add to the ways of a quad and of those of a chunk that it pierces, but for neighbours, and in a neck
    for what is folded up there too.
    """
    c = vec4i_at(mesh.quads, q)
    joint = joint_of_neck(q, mesh, welds)
    base = int_at(mesh.chunk_quad, other)
    close = near_quads(q, other, mesh, contacts)
    while close != 0:
        r = base + lowest_bit(close)
        close &= close - 1
        d = vec4i_at(mesh.quads, r)
        if (joint < 0 or joint_of_neck(r, mesh, welds) != joint) and not share_corner(c, d):
            lead_quad_back(c, d, contacts, state.x)


@wp.kernel
def find_ways_back(
    parts: int,
    sculptures: Sculptures,
    mesh: Mesh,
    balloons: Balloons,
    welds: Welds,
    contacts: Contacts,
    state: State,
):
    """Sum up for every vertex how it is led where walls have gone through each other; so many `parts` of the
    other chunks for each chunk, by a warp of lanes each on a GPU.
    """
    group, lane = wp.tid()
    chunk = group // parts
    first = int_at(mesh.chunk_quad, chunk)
    if int_at(balloons.touching, int_at(mesh.quad_balloon, first)) == 0:
        return
    last = int_at(mesh.chunk_quad, chunk + 1)
    world = int_at(mesh.quad_world, first)
    begin = int_at(sculptures.world_chunk, world) + group % parts
    end = int_at(sculptures.world_chunk, world + 1)
    while begin < end:
        found = int(0)
        if begin + lane * parts < end:
            found = boxes_meet(chunk, begin + lane * parts, contacts)
        others = warp_ballot(found)
        while others != 0:
            other = begin + lowest_bit(others) * parts
            others &= others - 1
            for q in range(first + lane, last, wp.block_dim()):
                lead_chunk_back(q, other, mesh, welds, contacts, state)
        begin += wp.block_dim() * parts


@wp.kernel
def go_back(frame_seconds: float, mesh: Mesh, hands: Hands, contacts: Contacts, x: wp.array[wp.vec3]):
    """Move every vertex its way back within a frame; it has none then."""
    i = wp.tid()
    sums = contacts.way_back[i]
    if sums[3] == 0:
        return
    way = wp.vec3(float(sums[0]), float(sums[1]), float(sums[2])) / PER_UNIT
    # Each edge counts twice, with the faces on both its sides.
    share = wp.min(0.5 * float(sums[3]) / PER_UNIT, 1.0)
    far = frame_seconds * hands.leading[mesh.vertex_balloon[i]]
    x[i] = x[i] + way * (far * share / wp.max(wp.length(way), UNDECIDED))
    contacts.way_back[i] = wp.vec4i(0)
