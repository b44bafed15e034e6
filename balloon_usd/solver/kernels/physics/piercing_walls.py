"""Where walls have gone through each other, and the ways back: intersection contours become shorter, which
needs neither insides nor outsides (Volino & Magnenat-Thalmann 2006, "Resolving surface collisions through
intersection contour minimization").
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Crossings
from balloon_usd.solver.kernels.arrays.shared import Balloons, Contacts, Mesh, Sculptures
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, vec3_at, vec4i_at
from balloon_usd.solver.kernels.device.warp_reduce import lowest_bit, warp_ballot, warp_max3
from balloon_usd.solver.kernels.physics.surface import FAR

FLATTEST = wp.constant(0.1)
"""Least sine of the angle between an edge and a wall that it pierces: a flatter one is led as if it had this,
else it would be led without limit.
"""
LONGER = wp.constant(0.01)
"""How much longer an edge and wider a triangle is taken to be, in themselves: so what does not pierce here
does not either where it is counted exactly.
"""
LEAST_RISE = wp.constant(1.0e-20)
"""Height of an edge's one end over the other, times an area, from which on it may pierce, m3."""
BENT = wp.constant(0.9)
"""Cosine between the normals of a quad's halves below which its diagonal may pierce what is beside it."""
PER_UNIT = wp.constant(65536.0)
"""Integers to 1 in sums of ways back: added as integers they do not depend on the order of threads."""


@wp.func
def is_corner(i: int, quad: wp.vec4i):
    """Return whether a vertex is a corner of a quad."""
    return i == quad[0] or i == quad[1] or i == quad[2] or i == quad[3]


@wp.func
def share_corner(c: wp.vec4i, d: wp.vec4i):
    """Return whether two quads have a vertex in common."""
    return is_corner(c[0], d) or is_corner(c[1], d) or is_corner(c[2], d) or is_corner(c[3], d)


@wp.func
def lead_back(i: int, share: float, way: wp.vec3, crossings: Crossings):
    """Add to the way of a vertex, by its share in what is led."""
    whole = wp.vec4i(0)
    for k in range(3):
        whole[k] = int(wp.round(PER_UNIT * share * way[k]))
    whole[3] = int(wp.round(PER_UNIT * wp.abs(share)))
    wp.atomic_add(crossings.way_back, i, whole)


@wp.func
def neck_at(joint: int, necks: wp.array[int]):
    """Return the neck of a joint; -1 for none."""
    if joint >= 0:
        return int_at(necks, joint)
    return -1


@wp.func
def counts(ends: wp.vec2i, d: wp.vec4i, neck: int, necks: wp.array[int], mesh: Mesh):
    """Return whether an edge may not pierce a quad: it is no neighbour, and not folded up in its neck.

    `neck`: of the quad.
    """
    if is_corner(ends[0], d) or is_corner(ends[1], d):
        return False
    if neck < 0:
        return True
    return (
        neck_at(int_at(mesh.vertex_neck, ends[0]), necks) != neck
        or neck_at(int_at(mesh.vertex_neck, ends[1]), necks) != neck
    )


@wp.func
def lead_edge_back(
    ends: wp.vec2i,
    p: wp.vec3,
    q: wp.vec3,
    inward: wp.vec3,
    below: float,
    above: float,
    d: wp.vec4i,
    other: wp.vec3i,
    a: wp.vec3,
    b: wp.vec3,
    c: wp.vec3,
    neck: int,
    world: int,
    necks: wp.array[int],
    mesh: Mesh,
    crossings: Crossings,
):
    """Count an edge that pierces a triangle, and add to the ways of both how the contour in one face of the
    edge becomes shorter.

    `p`, `q`: ends of the edge, m; `inward`: third corner of its face, m; `below`, `above`: heights of the
    ends above the triangle's plane, times twice its area; `d`, `neck`: quad of the triangle and its neck;
    `a`, `b`, `c`: corners of the triangle, m.
    """
    rise = below - above
    share = below / wp.where(wp.abs(rise) < LEAST_RISE, LEAST_RISE, rise)
    if share < -LONGER or share > 1.0 + LONGER:
        return
    place = p + share * (q - p)
    across = wp.cross(b - a, c - a)
    size = wp.max(wp.dot(across, across), 1.0e-30)
    first = wp.dot(wp.cross(b - place, c - place), across) / size
    second = wp.dot(wp.cross(c - place, a - place), across) / size
    third = 1.0 - first - second
    if wp.min(wp.min(first, second), third) < -LONGER or not counts(ends, d, neck, necks, mesh):
        return
    wp.atomic_add(crossings.pierced_count, world, 1)
    normal = across / wp.sqrt(size)
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
    lead_back(other[0], -first, way, crossings)
    lead_back(other[1], -second, way, crossings)
    lead_back(other[2], -third, way, crossings)


@wp.func
def lead_triangle_back(
    own: wp.vec3i,
    p0: wp.vec3,
    p1: wp.vec3,
    p2: wp.vec3,
    d: wp.vec4i,
    other: wp.vec3i,
    a: wp.vec3,
    b: wp.vec3,
    c: wp.vec3,
    neck: int,
    world: int,
    necks: wp.array[int],
    mesh: Mesh,
    crossings: Crossings,
):
    """Add to the ways of two triangles how the contours at the edges of the first become shorter."""
    across = wp.cross(b - a, c - a)
    h0 = wp.dot(across, p0 - a)
    h1 = wp.dot(across, p1 - a)
    h2 = wp.dot(across, p2 - a)
    for k in range(3):
        ends = wp.vec2i(own[0], own[1])
        p = p0
        q = p1
        inward = p2
        below = h0
        above = h1
        if k == 1:
            ends = wp.vec2i(own[1], own[2])
            p = p1
            q = p2
            inward = p0
            below = h1
            above = h2
        elif k == 2:
            ends = wp.vec2i(own[2], own[0])
            p = p2
            q = p0
            inward = p1
            below = h2
            above = h0
        lead_edge_back(
            ends, p, q, inward, below, above, d, other, a, b, c, neck, world, necks, mesh, crossings
        )


@wp.func
def beyond(across: wp.vec3, a: wp.vec3, x0: wp.vec3, x1: wp.vec3, x2: wp.vec3, x3: wp.vec3):
    """Return whether four points are on one side of a plane through `a`."""
    h0 = wp.dot(across, x0 - a)
    h1 = wp.dot(across, x1 - a)
    h2 = wp.dot(across, x2 - a)
    h3 = wp.dot(across, x3 - a)
    low = wp.min(wp.min(h0, h1), wp.min(h2, h3))
    high = wp.max(wp.max(h0, h1), wp.max(h2, h3))
    over = LONGER * (high - low)
    return low > over or high < -over


@wp.func
def lead_quad_back(
    c: wp.vec4i,
    d: wp.vec4i,
    neck: int,
    world: int,
    necks: wp.array[int],
    mesh: Mesh,
    crossings: Crossings,
    x: wp.array[wp.vec3],
):
    """Add to the ways of two quads how the contours at the edges of the first, diagonal included, become
    shorter.

    `neck`: of the second quad.
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
            for part in range(2):
                own = wp.vec3i(c[0], c[1 + part], c[2 + part])
                q1 = wp.where(part == 0, p1, p2)
                q2 = wp.where(part == 0, p2, p3)
                lead_triangle_back(own, p0, q1, q2, d, other, a, b, e, neck, world, necks, mesh, crossings)


@wp.func
def boxes_meet(chunk: int, other: int, crossings: Crossings):
    """Return 1 where the bounding boxes of two chunks overlap."""
    low = vec3_at(crossings.box_low, chunk)
    high = vec3_at(crossings.box_high, chunk)
    other_low = vec3_at(crossings.box_low, other)
    other_high = vec3_at(crossings.box_high, other)
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
def near_quads(q: int, other: int, mesh: Mesh, contacts: Contacts, crossings: Crossings):
    """Return the bits of those quads of a chunk that are near a quad."""
    middle = vec3_at(contacts.quad_middle, q)
    radius = float_at(crossings.quad_radius, q)
    off = wp.max(
        wp.max(vec3_at(crossings.box_low, other) - middle, middle - vec3_at(crossings.box_high, other)),
        wp.vec3(0.0),
    )
    bits = int(0)
    if wp.dot(off, off) < radius * radius:
        base = int_at(mesh.chunk_quad, other)
        for r in range(base, int_at(mesh.chunk_quad, other + 1)):
            d = middle - vec3_at(contacts.quad_middle, r)
            near = radius + float_at(crossings.quad_radius, r)
            if wp.dot(d, d) < near * near:
                bits |= 1 << (r - base)
    return bits


@wp.func
def may_pierce(
    q: int,
    r: int,
    c: wp.vec4i,
    d: wp.vec4i,
    neck: int,
    quad_bent: wp.array[int],
    quad_area: wp.array[wp.vec3],
):
    """Return whether edges of quad q may pierce quad r: neighbours do only where the wall is folded over,
    or q itself is.

    `c`, `d`: their corners; `neck`: that in which both lie, -1 for none.
    """
    if neck >= 0:
        return False
    if not share_corner(c, d) or int_at(quad_bent, q) == 1:
        return True
    return wp.dot(vec3_at(quad_area, q), vec3_at(quad_area, r)) < 0.0


@wp.func
def lead_chunk_back(
    q: int,
    other: int,
    world: int,
    necks: wp.array[int],
    mesh: Mesh,
    contacts: Contacts,
    crossings: Crossings,
):
    """Add to the ways of a quad and of those of a chunk that its edges pierce."""
    c = vec4i_at(mesh.quads, q)
    own = neck_at(int_at(mesh.quad_neck, q), necks)
    base = int_at(mesh.chunk_quad, other)
    close = near_quads(q, other, mesh, contacts, crossings)
    while close != 0:
        r = base + lowest_bit(close)
        close &= close - 1
        d = vec4i_at(mesh.quads, r)
        neck = neck_at(int_at(mesh.quad_neck, r), necks)
        if may_pierce(q, r, c, d, wp.where(neck == own, neck, -1), crossings.quad_bent, contacts.quad_area):
            lead_quad_back(c, d, neck, world, necks, mesh, crossings, crossings.x_shown)


@wp.kernel
def box_walls(mesh: Mesh, contacts: Contacts, crossings: Crossings):
    """Write the middle (m), the vector area (m2) and the radius (m) of every quad and whether it is bent, and
    the box (m) about the quads of every chunk; a warp of lanes each on a GPU.
    """
    chunk, lane = wp.tid()
    if chunk == 0 and lane == 0:
        crossings.untangling[0] = 0
    high = wp.vec3(-FAR)
    low = wp.vec3(FAR)
    for q in range(mesh.chunk_quad[chunk] + lane, mesh.chunk_quad[chunk + 1], wp.block_dim()):
        c = mesh.quads[q]
        x0 = crossings.x_shown[c[0]]
        x1 = crossings.x_shown[c[1]]
        x2 = crossings.x_shown[c[2]]
        x3 = crossings.x_shown[c[3]]
        middle = 0.25 * (x0 + x1 + x2 + x3)
        contacts.quad_middle[q] = middle
        contacts.quad_area[q] = 0.5 * wp.cross(x2 - x0, x3 - x1)
        crossings.quad_radius[q] = wp.max(
            wp.max(wp.length(x0 - middle), wp.length(x1 - middle)),
            wp.max(wp.length(x2 - middle), wp.length(x3 - middle)),
        )
        one = wp.normalize(wp.cross(x1 - x0, x2 - x0))
        other = wp.normalize(wp.cross(x2 - x0, x3 - x0))
        crossings.quad_bent[q] = wp.where(wp.dot(one, other) < BENT, 1, 0)
        high = wp.max(high, wp.max(wp.max(x0, x1), wp.max(x2, x3)))
        low = wp.min(low, wp.min(wp.min(x0, x1), wp.min(x2, x3)))
    high = warp_max3(high)
    low = -warp_max3(-low)
    if lane == 0:
        crossings.box_low[chunk] = low
        crossings.box_high[chunk] = high


@wp.kernel
def find_ways_back(
    parts: int,
    necks: wp.array[int],
    sculptures: Sculptures,
    mesh: Mesh,
    balloons: Balloons,
    contacts: Contacts,
    crossings: Crossings,
):
    """Sum up for every vertex how it is led where walls have gone through each other, and count the edges
    that pierce a face, but for rubber of one neck; so many `parts` of the other chunks for each chunk, by a
    warp of lanes each on a GPU.

    `necks`: neck of every joint.
    """
    group, lane = wp.tid()
    chunk = group // parts
    first = int_at(mesh.chunk_quad, chunk)
    world = int_at(mesh.quad_world, first)
    if int_at(crossings.untangling_round, world) < 0:
        return
    if int_at(balloons.touching, int_at(mesh.quad_balloon, first)) == 0:
        return
    last = int_at(mesh.chunk_quad, chunk + 1)
    begin = int_at(sculptures.world_chunk, world) + group % parts
    end = int_at(sculptures.world_chunk, world + 1)
    while begin < end:
        found = int(0)
        if begin + lane * parts < end:
            found = boxes_meet(chunk, begin + lane * parts, crossings)
        others = warp_ballot(found)
        while others != 0:
            other = begin + lowest_bit(others) * parts
            others &= others - 1
            for q in range(first + lane, last, wp.block_dim()):
                lead_chunk_back(q, other, world, necks, mesh, contacts, crossings)
        begin += wp.block_dim() * parts
