"""Where walls go through each other: pairs of quads by the boxes of chunks, then edges against triangles."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Crossings
from balloon_usd.solver.kernels.arrays.shared import Balloons, Contacts, Mesh, Sculptures
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, vec3_at, vec4i_at
from balloon_usd.solver.kernels.device.warp_reduce import lowest_bit, warp_ballot, warp_max3
from balloon_usd.solver.kernels.physics.piercing_edge import LONGER, answer_edge, neck_at, share_corner
from balloon_usd.solver.kernels.physics.surface import FAR

BENT = wp.constant(0.97)
"""Cosine between the normals of a quad's halves below which its diagonal may pierce what is beside it."""
FOLDED = wp.constant(0.85)
"""Cosine between the normals of two quads at a corner below which they may pierce each other."""


@wp.func
def answer_triangle(
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
    together: int,
    world: int,
    mesh: Mesh,
    contacts: Contacts,
    crossings: Crossings,
):
    """Answer the edges of a triangle that pierce another one: both are led apart, or go on as one."""
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
        answer_edge(
            ends,
            p,
            q,
            inward,
            below,
            above,
            d,
            other,
            a,
            b,
            c,
            neck,
            together,
            world,
            mesh,
            contacts,
            crossings,
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
def answer_quad(
    c: wp.vec4i,
    d: wp.vec4i,
    neck: int,
    together: int,
    world: int,
    mesh: Mesh,
    contacts: Contacts,
    crossings: Crossings,
    x: wp.array[wp.vec3],
):
    """Answer the edges of a quad, diagonal included, that pierce another one, whose neck is `neck`."""
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
                answer_triangle(
                    own, p0, q1, q2, d, other, a, b, e, neck, together, world, mesh, contacts, crossings
                )


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
    or one of them is.

    `c`, `d`: their corners; `neck`: that in which both lie, -1 for none.
    """
    if neck >= 0:
        return False
    if not share_corner(c, d) or int_at(quad_bent, q) + int_at(quad_bent, r) > 0:
        return True
    own = vec3_at(quad_area, q)
    beside = vec3_at(quad_area, r)
    return wp.dot(own, beside) < FOLDED * wp.sqrt(wp.dot(own, own) * wp.dot(beside, beside))


@wp.func
def answer_chunk(
    q: int,
    other: int,
    together: int,
    world: int,
    mesh: Mesh,
    contacts: Contacts,
    crossings: Crossings,
):
    """Answer the edges of a quad that pierce quads of a chunk."""
    c = vec4i_at(mesh.quads, q)
    own = neck_at(int_at(mesh.quad_neck, q), crossings.joint_meant)
    base = int_at(mesh.chunk_quad, other)
    close = near_quads(q, other, mesh, contacts, crossings)
    while close != 0:
        r = base + lowest_bit(close)
        close &= close - 1
        d = vec4i_at(mesh.quads, r)
        neck = neck_at(int_at(mesh.quad_neck, r), crossings.joint_meant)
        if may_pierce(q, r, c, d, wp.where(neck == own, neck, -1), crossings.quad_bent, contacts.quad_area):
            answer_quad(c, d, neck, together, world, mesh, contacts, crossings, crossings.x_apart)


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
        x0 = crossings.x_apart[c[0]]
        x1 = crossings.x_apart[c[1]]
        x2 = crossings.x_apart[c[2]]
        x3 = crossings.x_apart[c[3]]
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
def find_piercing_walls(
    parts: int,
    together: int,
    sculptures: Sculptures,
    mesh: Mesh,
    balloons: Balloons,
    contacts: Contacts,
    crossings: Crossings,
):
    """Sum up for every vertex how it is led out of walls that it has gone through, or how it and they go on
    `together`, and count the edges that pierce a face, but for rubber of one neck; so many `parts` of the
    other chunks for each chunk, by a warp of lanes each on a GPU.
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
                answer_chunk(q, other, together, world, mesh, contacts, crossings)
        begin += wp.block_dim() * parts
