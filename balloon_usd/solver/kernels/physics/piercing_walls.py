"""Where walls go through each other: pairs of quads by the boxes of chunks, then edges against triangles."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Crossings
from balloon_usd.solver.kernels.arrays.shared import Balloons, Contacts, Mesh, Sculptures
from balloon_usd.solver.kernels.device.array_access import int_at, vec3_at, vec4i_at
from balloon_usd.solver.kernels.device.chunk_rows import (
    in_row,
    lanes_between,
    near_spheres,
    put_in_row,
    put_middle,
)
from balloon_usd.solver.kernels.device.search_lanes import search_lanes
from balloon_usd.solver.kernels.device.warp_reduce import (
    block_lanes,
    lowest_bit,
    warp_ballot,
    warp_max3,
    warp_or,
    without_lowest,
)
from balloon_usd.solver.kernels.physics.piercing_edge import (
    LONGER,
    answer_edge,
    goes_through,
    is_corner,
)
from balloon_usd.solver.kernels.physics.surface import FAR, farthest


@wp.func
def beyond(h0: float, h1: float, h2: float, h3: float):
    """Return whether four points are on one side of a plane, given their heights above it."""
    low = wp.min(wp.min(h0, h1), wp.min(h2, h3))
    high = wp.max(wp.max(h0, h1), wp.max(h2, h3))
    over = LONGER * (high - low)
    return low > over or high < -over


@wp.func
def edges_through(
    c: wp.vec4i,
    d: wp.vec4i,
    p0: wp.vec3,
    p1: wp.vec3,
    p2: wp.vec3,
    p3: wp.vec3,
    a: wp.vec3,
    b: wp.vec3,
    e: wp.vec3,
):
    """Return the bits of those edges of a quad that may pierce a triangle of another one: 3 of each half, the
    diagonal twice.

    `c`, `d`: corners of both; `p0` to `p3`: those of the first, `a`, `b`, `e`: those of the triangle, m.
    """
    bits = int(0)
    # An edge that ends at a corner of the other quad pierces nothing.
    free0 = not is_corner(c[0], d)
    free1 = not is_corner(c[1], d)
    free2 = not is_corner(c[2], d)
    free3 = not is_corner(c[3], d)
    across = wp.cross(b - a, e - a)
    h0 = wp.dot(across, p0 - a)
    h1 = wp.dot(across, p1 - a)
    h2 = wp.dot(across, p2 - a)
    h3 = wp.dot(across, p3 - a)
    # So neighbours are soon told apart, without a look at how they are folded.
    one = wp.where(free0, h0, wp.where(free1, h1, wp.where(free2, h2, h3)))
    other0 = wp.where(free0, h0, one)
    other1 = wp.where(free1, h1, one)
    other2 = wp.where(free2, h2, one)
    if not beyond(other0, other1, other2, wp.where(free3, h3, one)):
        if free0 and free1 and goes_through(p0, p1, h0, h1, a, b, e, across):
            bits |= 1
        if free1 and free2 and goes_through(p1, p2, h1, h2, a, b, e, across):
            bits |= 2
        if free2 and free0 and goes_through(p2, p0, h2, h0, a, b, e, across):
            bits |= 4 | 8
        if free2 and free3 and goes_through(p2, p3, h2, h3, a, b, e, across):
            bits |= 16
        if free3 and free0 and goes_through(p3, p0, h3, h0, a, b, e, across):
            bits |= 32
    return bits


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
):
    """Answer the edges of a quad, diagonal included, that pierce another one, whose neck is `neck`."""
    p0 = vec3_at(crossings.x_apart, c[0])
    p1 = vec3_at(crossings.x_apart, c[1])
    p2 = vec3_at(crossings.x_apart, c[2])
    p3 = vec3_at(crossings.x_apart, c[3])
    a = vec3_at(crossings.x_apart, d[0])
    b = vec3_at(crossings.x_apart, d[1])
    e = vec3_at(crossings.x_apart, d[2])
    f = vec3_at(crossings.x_apart, d[3])
    bits = edges_through(c, d, p0, p1, p2, p3, a, b, e) | (edges_through(c, d, p0, p1, p2, p3, a, e, f) << 6)
    # One call for all: on a CPU each copies what all arrays are (a search of three ears: 2.4 -> 0.9 ms).
    while bits != 0:
        bit = lowest_bit(bits)
        bits &= bits - 1
        half = bit // 6
        part = (bit // 3) % 2
        k = bit % 3
        own = wp.vec3i(c[0], c[1 + part], c[2 + part])
        ends = wp.vec3i(own[k], own[(k + 1) % 3], own[(k + 2) % 3])
        other = wp.vec3i(d[0], d[1 + half], d[2 + half])
        answer_edge(ends, other, neck, together, world, mesh, contacts, crossings)


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
def near_quads(chunk: int, place: int, other: int, mesh: Mesh, crossings: Crossings):
    """Return the mask of those quads of another chunk that are near a quad, at this place in its chunk, where
    one of both is restless.
    """
    rows = crossings.sphere_rows
    middle = wp.vec3(
        in_row(rows, chunk, 0, place), in_row(rows, chunk, 1, place), in_row(rows, chunk, 2, place)
    )
    radius = in_row(rows, chunk, 3, place)
    off = wp.max(
        wp.max(vec3_at(crossings.box_low, other) - middle, middle - vec3_at(crossings.box_high, other)),
        wp.vec3(0.0),
    )
    near = int(0)
    if wp.dot(off, off) < radius * radius:
        near = lanes_between(0, int_at(mesh.chunk_quad, other + 1) - int_at(mesh.chunk_quad, other))
        if (int_at(crossings.chunk_restless, chunk) >> place) & 1 == 0:
            near &= int_at(crossings.chunk_restless, other)
        if near != 0:
            near &= near_spheres(rows, other, middle, radius)
    return near


@wp.func
def answer_chunk(
    chunk: int,
    q: int,
    other: int,
    part: int,
    together: int,
    world: int,
    mesh: Mesh,
    contacts: Contacts,
    crossings: Crossings,
):
    """Answer the edges of a quad that pierce quads of a chunk, a `part` of those near it: lanes that search
    together share them out.
    """
    c = vec4i_at(mesh.quads, q)
    own = int_at(mesh.quad_neck, q)
    base = int_at(mesh.chunk_quad, other)
    close = near_quads(chunk, q - int_at(mesh.chunk_quad, chunk), other, mesh, crossings)
    close = without_lowest(close, part)
    while close != 0:
        r = base + lowest_bit(close)
        close = without_lowest(close, search_lanes())
        d = vec4i_at(mesh.quads, r)
        neck = int_at(mesh.quad_neck, r)
        if neck < 0 or neck != own:
            answer_quad(c, d, neck, together, world, mesh, contacts, crossings)


@wp.func
def find_restless(chunk: int, lane: int, mesh: Mesh, crossings: Crossings):
    """Write which quads of a chunk have restless corners, and return their mask."""
    first = int_at(mesh.chunk_quad, chunk)
    mask = int(0)
    for q in range(first + lane, int_at(mesh.chunk_quad, chunk + 1), wp.block_dim()):
        c = vec4i_at(mesh.quads, q)
        restless = wp.max(
            wp.max(int_at(crossings.restless, c[0]), int_at(crossings.restless, c[1])),
            wp.max(int_at(crossings.restless, c[2]), int_at(crossings.restless, c[3])),
        )
        mask |= restless << (q - first)
    mask = warp_or(mask)
    if lane == 0:
        crossings.chunk_restless[chunk] = mask
    return mask


@wp.kernel
def box_walls(share_begin: int, mesh: Mesh, crossings: Crossings):
    """Write the middle (m) and the radius (m) of every quad, and the box (m) about the quads of every chunk,
    where any is restless; a warp of lanes each on a GPU, which also lists the chunks that are looked at.
    """
    group, lane = wp.tid()
    chunk = share_begin + group
    if chunk == 0 and lane == 0:
        crossings.untangling[0] = 0
    if int_at(crossings.untangling_round, int_at(mesh.quad_world, int_at(mesh.chunk_quad, chunk))) < 0:
        return
    if block_lanes() > 1 and lane == 0:
        crossings.looked_chunks[wp.atomic_add(crossings.looked_count, 0, 1)] = chunk
    if find_restless(chunk, lane, mesh, crossings) == 0:
        return
    high = wp.vec3(-FAR)
    low = wp.vec3(FAR)
    for q in range(mesh.chunk_quad[chunk] + lane, mesh.chunk_quad[chunk + 1], wp.block_dim()):
        c = mesh.quads[q]
        x0 = crossings.x_apart[c[0]]
        x1 = crossings.x_apart[c[1]]
        x2 = crossings.x_apart[c[2]]
        x3 = crossings.x_apart[c[3]]
        middle = 0.25 * (x0 + x1 + x2 + x3)
        place = q - mesh.chunk_quad[chunk]
        put_middle(crossings.sphere_rows, chunk, place, middle)
        put_in_row(crossings.sphere_rows, chunk, 3, place, farthest(middle, x0, x1, x2, x3))
        high = wp.max(high, wp.max(wp.max(x0, x1), wp.max(x2, x3)))
        low = wp.min(low, wp.min(wp.min(x0, x1), wp.min(x2, x3)))
    high = warp_max3(high)
    low = -warp_max3(-low)
    if lane == 0:
        crossings.box_low[chunk] = low
        crossings.box_high[chunk] = high


@wp.kernel
def find_piercing_walls(
    share_begin: int,
    parts: int,
    launched: int,
    together: int,
    sculptures: Sculptures,
    mesh: Mesh,
    balloons: Balloons,
    contacts: Contacts,
    crossings: Crossings,
):
    """Sum up for every vertex how it is led out of walls that it has gone through, or how it and they go on
    `together`, and count the edges that pierce a face, but for rubber of one neck.

    On a GPU a warp takes 8 quads of a chunk, in so many `parts` the chunks that they may pierce; lanes that
    search together share out what is near their quad. As many warps as are `launched` take turns: most chunks
    of a batch are of sculptures that need no further round, and a warp for each took 130 us a round for 85
    figures on an H200. A thread of the CPU takes the chunks of its share.
    """
    tile, lane = wp.tid()
    lanes = search_lanes()
    each = parts * lanes
    item = share_begin + tile
    items = item + 1
    if block_lanes() > 1:
        items = each * int_at(crossings.looked_count, 0)
    while item < items:
        chunk = item // each
        if block_lanes() > 1:
            chunk = int_at(crossings.looked_chunks, chunk)
        stretch = item // parts % lanes
        at_once = block_lanes() // lanes
        first = int_at(mesh.chunk_quad, chunk)
        world = int_at(mesh.quad_world, first)
        last = int_at(mesh.chunk_quad, chunk + 1)
        restless = int_at(crossings.chunk_restless, chunk)
        begin = int_at(sculptures.world_chunk, world) + item % parts
        end = int_at(sculptures.world_chunk, world + 1)
        looked = int_at(crossings.untangling_round, world) >= 0
        if not looked or int_at(balloons.touching, int_at(mesh.quad_balloon, first)) == 0:
            end = begin
        while begin < end:
            found = int(0)
            candidate = begin + lane * parts
            if candidate < end:
                # What has not moved since the last round pierces nothing that it did not then.
                if (restless | int_at(crossings.chunk_restless, candidate)) != 0:
                    found = boxes_meet(chunk, candidate, crossings)
            others = warp_ballot(found)
            while others != 0:
                other = begin + lowest_bit(others) * parts
                others &= others - 1
                for q in range(first + at_once * stretch + lane // lanes, last, at_once * lanes):
                    answer_chunk(chunk, q, other, lane % lanes, together, world, mesh, contacts, crossings)
            begin += block_lanes() * parts
        item += launched
