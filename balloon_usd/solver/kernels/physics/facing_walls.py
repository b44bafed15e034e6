"""The search for walls that face each other: broad phase over bounding boxes of chunks of quads, narrow phase
against bilinear patches.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import Touch
from balloon_usd.solver.kernels.arrays.shared import Balloons, Contacts, Hands, Mesh, Sculptures, State
from balloon_usd.solver.kernels.device.array_access import (
    float_at,
    int_at,
    int_in,
    vec3_at,
    vec4i_at,
)
from balloon_usd.solver.kernels.device.atomic import add_int, exchange_int
from balloon_usd.solver.kernels.device.chunk_rows import lanes_between, within_reach
from balloon_usd.solver.kernels.device.search_lanes import float_from_beside, int_from_beside, search_lanes
from balloon_usd.solver.kernels.device.soa import store_soa
from balloon_usd.solver.kernels.device.warp_reduce import (
    lowest_bit,
    warp_ballot,
    warp_max,
    warp_max3,
    without_lowest,
)
from balloon_usd.solver.kernels.physics.meeting import (
    FOLDED,
    INSIDE,
    Seeker,
    in_wall,
    may_meet,
    opposite,
    round_wall,
    seeker_of,
)
from balloon_usd.solver.kernels.physics.motion import LYING, SLOW
from balloon_usd.solver.kernels.physics.patch import SIDE_SLIP, nearest_on_patch, patch_shares
from balloon_usd.solver.kernels.physics.surface import FAR, GROUP, surface_of_vertex, velocity_of_spin

FACING = wp.constant(-0.1)
"""Walls face each other when the dot product of their outward normals is below this."""
DEPTH_LIMIT = wp.constant(0.6)
"""Deepest overlap taken for a contact, in local tube radii: beyond it the other wall is the tube's far
side.
"""
ROUNDING = wp.constant(0.1)
"""The same where walls are kept apart, in the distance at which they begin to press: there no wall is behind
another. What seemed to be was flung through a third wall, and by 7 mm in a frame after the let-go.
"""
STAYING = wp.constant(0.6)
"""Nearness that a wall gains while it is touched once hands loosen their grip, in the distance at which walls
begin to press: where two were about as near, figures fluttered (vertices that change direction by 0.3 mm a
frame: 2295 -> 1063 in 48 figures). Where hands still press, the nearest wall must be pressed on.
"""
OWN = wp.constant(256)
"""Most quads before a vertex, and after it, that are known as its own."""
NONE = wp.constant(1 << 30)
"""Index beyond any other."""
ROUNDED = wp.constant(1.001)
"""Inflation of a warp's bounding box, so that rounding culls nothing that is within reach of one of its
lanes.
"""


@wp.func
def distance_beside(
    q: int, face: wp.vec3, most: float, p: wp.vec3, quads: wp.array[wp.vec4i], x: wp.array[wp.vec3]
):
    """Return the distance (m) of a point from a quad, or FAR where the point lies more than `most` (m) beside
    it.
    """
    c = vec4i_at(quads, q)
    x0 = vec3_at(x, c[0])
    x1 = vec3_at(x, c[1])
    x2 = vec3_at(x, c[2])
    x3 = vec3_at(x, c[3])
    s = patch_shares(nearest_on_patch(x0, x1, x2, x3, p))
    gap = p - (s[0] * x0 + s[1] * x1 + s[2] * x2 + s[3] * x3)
    distance = float(FAR)
    if wp.length(gap - wp.dot(gap, face) * face) < most:
        distance = wp.length(gap)
    return distance


@wp.kernel
def find_own_walls(touch: Touch, mesh: Mesh, balloons: Balloons, vertex_own: wp.array[wp.vec2i]):
    """Write for every vertex the first and the end of a run of quads about it that it never touches."""
    i = wp.tid()
    seeker = seeker_of(i, touch, mesh, balloons)
    middle = wp.max(mesh.corners[i][0], 0) // 4
    first = wp.max(middle - OWN, 0)
    begin = int(middle)
    while begin > first and not may_meet(wp.max(begin - 1, first), seeker, mesh):
        begin -= 1
    last = wp.min(middle + OWN, mesh.quads.shape[0]) - 1
    end = int(middle)
    while end <= last and not may_meet(wp.min(end, last), seeker, mesh):
        end += 1
    vertex_own[i] = wp.vec2i(begin, end)


@wp.func
def distance_of_wall(
    q: int,
    d: wp.vec3,
    seeker: Seeker,
    touch: Touch,
    mesh: Mesh,
    contacts: Contacts,
    state: State,
):
    """Return the distance (m) of a vertex from a quad that faces it, or FAR where the two never touch.

    `d`: from the quad's middle to the vertex, m.
    """
    distance = float(FAR)
    a = vec3_at(contacts.quad_area, q)
    size = wp.length(a)
    face = a / wp.max(size, 1.0e-12)
    normal = seeker.normal
    if seeker.nested == 1:
        face = wp.where(in_wall(q, seeker, mesh), -face, face)
        normal = wp.where(round_wall(q, seeker, mesh), -normal, normal)
    if wp.dot(face, normal) < FACING and may_meet(q, seeker, mesh):
        height = wp.dot(d, face)
        limit = wp.min(seeker.depth, DEPTH_LIMIT * float_at(contacts.ring_radius, int_at(mesh.quad_ring, q)))
        folded = seeker.neck >= 0 and int_at(mesh.quad_neck, q) == seeker.neck
        limit = wp.min(limit, wp.where(folded, FOLDED / ROUNDING, 1.0) * seeker.apart_depth)
        going = seeker.velocity - vec3_at(contacts.quad_velocity, q)
        watched = touch.margin + touch.ahead * wp.max(wp.length(going), seeker.speed)
        if opposite(q, seeker, mesh):
            height = -height
            watched += INSIDE * seeker.offset
            limit = wp.min(limit, watched)
        else:
            watched += seeker.offset + seeker.arc * size
        if height > -limit and height < watched:
            beside = SIDE_SLIP * wp.sqrt(size)
            distance = distance_beside(q, face, beside, seeker.position, mesh.quads, state.x)
    return distance


@wp.func
def weigh_wall(
    q: int,
    near: wp.vec2,
    nearest: wp.vec2i,
    before: wp.vec2i,
    seeker: Seeker,
    touch: Touch,
    mesh: Mesh,
    contacts: Contacts,
    state: State,
):
    """Return the distances (m) of the two nearest quads of different bubbles, and these, after one more;
    those touched before count as nearer.
    """
    d = seeker.position - vec3_at(contacts.quad_middle, q)
    distance = distance_of_wall(q, d, seeker, touch, mesh, contacts, state)
    if distance < FAR and (q == before[0] or q == before[1]):
        distance -= seeker.staying
    other = nearest[0] >= 0 and int_at(mesh.quad_segment, wp.max(nearest[0], 0)) != int_at(
        mesh.quad_segment, q
    )
    if distance < near[0]:
        if other:
            near = wp.vec2(distance, near[0])
            nearest = wp.vec2i(q, nearest[0])
        else:
            near = wp.vec2(distance, near[1])
            nearest = wp.vec2i(q, nearest[1])
    elif distance < near[1] and other:
        near = wp.vec2(near[0], distance)
        nearest = wp.vec2i(nearest[0], q)
    return near, nearest


@wp.func
def weigh_walls(
    chunk: int,
    close: int,
    part: int,
    near: wp.vec2,
    nearest: wp.vec2i,
    before: wp.vec2i,
    seeker: Seeker,
    touch: Touch,
    mesh: Mesh,
    contacts: Contacts,
    state: State,
):
    """Return the same after a `part` of those quads of a chunk whose bits are set: lanes that search together
    share them out. Every lane tests one a round, until no lane has any left.
    """
    base = int_at(mesh.chunk_quad, chunk)
    left = without_lowest(close, part)
    while warp_ballot(wp.where(left != 0, 1, 0)) != 0:
        if left != 0:
            q = base + lowest_bit(left)
            near, nearest = weigh_wall(q, near, nearest, before, seeker, touch, mesh, contacts, state)
            left = without_lowest(left, search_lanes())
    return near, nearest


@wp.func
def nearer(q: int, distance: float, other: int, other_distance: float):
    """Return whether a quad is nearer than another one, or as near and met before; -1 for none."""
    return q >= 0 and (other < 0 or distance < other_distance or (distance == other_distance and q < other))


@wp.func
def nearest_of_all(near: wp.vec2, nearest: wp.vec2i, mesh: Mesh):
    """Return the two nearest quads of different bubbles, and their distances (m), of what all lanes that
    search together have found: what one alone would have.
    """
    step = int(1)
    while step < search_lanes():
        distance0 = float_from_beside(near[0], step)
        distance1 = float_from_beside(near[1], step)
        other0 = int_from_beside(nearest[0], step)
        other1 = int_from_beside(nearest[1], step)
        theirs = nearer(other0, distance0, nearest[0], near[0])
        winner = wp.where(theirs, wp.vec2i(other0, other1), nearest)
        winner_near = wp.where(theirs, wp.vec2(distance0, distance1), near)
        loser = wp.where(theirs, nearest, wp.vec2i(other0, other1))
        loser_near = wp.where(theirs, near, wp.vec2(distance0, distance1))
        # The loser's first, if of another bubble, else its second, which is.
        second = loser[0]
        second_near = loser_near[0]
        if int_at(mesh.quad_segment, wp.max(loser[0], 0)) == int_at(mesh.quad_segment, wp.max(winner[0], 0)):
            second = loser[1]
            second_near = loser_near[1]
        theirs = nearer(second, second_near, winner[1], winner_near[1])
        near = wp.vec2(winner_near[0], wp.where(theirs, second_near, winner_near[1]))
        nearest = wp.vec2i(winner[0], wp.where(theirs, second, winner[1]))
        step *= 2
    return near, nearest


@wp.func
def chunk_in_box(chunk: int, low: wp.vec3, high: wp.vec3, own: wp.vec2i, mesh: Mesh, contacts: Contacts):
    """Return 1 where a chunk reaches into a box (m) and has other quads than a run of own ones."""
    found = int(0)
    chunk_l = vec3_at(contacts.chunk_low, chunk)
    chunk_h = vec3_at(contacts.chunk_high, chunk)
    # The first axis already culls most chunks.
    if chunk_l[0] < high[0] and chunk_h[0] > low[0]:
        if chunk_l[1] < high[1] and chunk_h[1] > low[1] and chunk_l[2] < high[2] and chunk_h[2] > low[2]:
            if own[0] > int_at(mesh.chunk_quad, chunk) or own[1] < int_at(mesh.chunk_quad, chunk + 1):
                found = 1
    return found


@wp.func
def begins_far_group(chunk: int, low: wp.vec3, high: wp.vec3, contacts: Contacts):
    """Return whether a group of chunks begins with this one and reaches nowhere into a box (m)."""
    far = bool(False)
    group = chunk // GROUP
    if chunk == GROUP * group:
        beyond = wp.max(vec3_at(contacts.group_low, group) - high, low - vec3_at(contacts.group_high, group))
        far = wp.max(beyond) > 0.0
    return far


@wp.func
def close_quads_of_chunk(chunk: int, own: wp.vec2i, seeker: Seeker, mesh: Mesh, contacts: Contacts):
    """Return the bits of those quads of a chunk that are within a vertex's reach, but for a run of its own
    ones.
    """
    base = int_at(mesh.chunk_quad, chunk)
    first = int(base)
    end = int_at(mesh.chunk_quad, chunk + 1)
    # Trim the vertex's own neighbourhood from either end of the chunk.
    if own[0] <= base:
        first = wp.max(first, own[1])
    if own[1] >= end:
        end = wp.min(end, own[0])
    p = seeker.position
    off = wp.max(
        wp.max(vec3_at(contacts.chunk_low, chunk) - p, p - vec3_at(contacts.chunk_high, chunk)),
        wp.vec3(0.0),
    )
    close = int(0)
    if wp.dot(off, off) < seeker.reach * seeker.reach:
        close = within_reach(contacts.reach_rows, chunk, p, seeker.reach) & lanes_between(
            first - base, end - base
        )
    return close


@wp.func
def enter_walls(
    i: int,
    p: wp.vec3,
    found: wp.vec2i,
    before: wp.vec2i,
    world: int,
    sculptures: Sculptures,
    mesh: Mesh,
    contacts: Contacts,
    state: State,
):
    """Enter the walls that a vertex was found to touch in their lists and in that of its sculpture, with what
    it has slipped on those that it touched before.
    """
    listed = 2 * sculptures.world_vertex[world]
    slip0 = contacts.slip[i, 0]
    slip1 = contacts.slip[i, 1]
    for k in range(2):
        kept = wp.vec3(0.0)
        if found[k] >= 0:
            if before[0] >= 0 and mesh.quad_segment[before[0]] == mesh.quad_segment[found[k]]:
                kept = slip0
            elif before[1] >= 0 and mesh.quad_segment[before[1]] == mesh.quad_segment[found[k]]:
                kept = slip1
            c = mesh.quads[found[k]]
            contacts.contact_place[2 * i + k] = nearest_on_patch(
                state.x[c[0]], state.x[c[1]], state.x[c[2]], state.x[c[3]], p
            )
            contacts.hit_before[2 * i + k] = exchange_int(contacts.hit_last, found[k], 2 * i + k)
            contacts.pairs[listed + add_int(contacts.pair_count, world, 1)] = 2 * i + k
        else:
            store_soa(contacts.contact_force, i, k, wp.vec3(0.0))
        contacts.target[i, k] = found[k]
        contacts.slip[i, k] = kept


@wp.func
def seeker_at(
    i: int,
    normal: wp.vec3,
    touch: Touch,
    mesh: Mesh,
    balloons: Balloons,
    hands: Hands,
    contacts: Contacts,
    state: State,
):
    """Return a vertex that looks for walls from where it is; `normal`: its outward unit normal."""
    seeker = seeker_of(i, touch, mesh, balloons)
    seeker.position = state.x[i]
    seeker.velocity = state.v[i] + velocity_of_spin(i, state.x[i], hands)
    seeker.normal = normal
    seeker.depth = DEPTH_LIMIT * contacts.ring_radius[mesh.vertex_ring[i]]
    seeker.apart_depth = wp.where(contacts.crossed[i] == 0, ROUNDING * seeker.offset, FAR)
    seeker.staying = wp.where(hands.floating[seeker.balloon] == 1, STAYING * seeker.offset, 0.0)
    if contacts.watched[balloons.balloon_world[seeker.balloon]] > 0:
        # Rubber that is folded up in a neck, and pressed, jitters for as long as its surroundings are led.
        seeker.neck = -1
    # What would have crossed is soon as fast as it may be, and so is what it would have crossed.
    seeker.speed = wp.where(state.slowness[i] > 0.0, 2.0 * SLOW, 0.0)
    farthest = touch.ahead * wp.max(wp.length(seeker.velocity), seeker.speed)
    seeker.reach = seeker.offset + touch.margin + farthest
    return seeker


@wp.kernel
def find_walls(
    share_begin: int,
    touch: Touch,
    sculptures: Sculptures,
    mesh: Mesh,
    balloons: Balloons,
    hands: Hands,
    contacts: Contacts,
    state: State,
):
    """Choose for every vertex the nearest facing quads, of different bubbles, and enter it in their lists;
    write its outward unit normal and its share of the wall's area (m2).

    On a GPU a warp searches for 8 neighbouring vertices: a broad phase culls chunks by the bounding box of
    the whole warp, in a narrow phase lanes that search together share out the candidates of their vertex.
    """
    group, lane = wp.tid()
    lanes = search_lanes()
    i = ((share_begin + group) * wp.block_dim() + lane) // lanes
    part = lane % lanes
    spare = i >= state.x.shape[0]
    i = wp.min(i, state.x.shape[0] - 1)
    outward, size = surface_of_vertex(i, mesh.corners, contacts.quad_area)
    seeker = seeker_at(i, wp.normalize(outward), touch, mesh, balloons, hands, contacts, state)
    if part == 0:
        contacts.normal[i] = seeker.normal
        contacts.area[i] = size
    own = contacts.vertex_own[i]
    world = balloons.balloon_world[seeker.balloon]
    near = wp.vec2(FAR, FAR)
    nearest = wp.vec2i(-1, -1)
    before = wp.vec2i(int_in(contacts.target, i, 0), int_in(contacts.target, i, 1))
    first = sculptures.world_chunk[world]
    last = sculptures.world_chunk[world + 1]
    # Bounding box of the warp: what is within reach of any of its lanes.
    low = seeker.position - wp.vec3(ROUNDED * seeker.reach)
    high = seeker.position + wp.vec3(ROUNDED * seeker.reach)
    own_of_all = own
    touching = balloons.touching[seeker.balloon]
    if spare or touching == 0 or touching == LYING:
        first = NONE
        last = -NONE
        low = wp.vec3(FAR)
        high = wp.vec3(-FAR)
        own_of_all = wp.vec2i(-NONE, NONE)
    low = -warp_max3(-low)
    high = warp_max3(high)
    own_of_all = wp.vec2i(warp_max(own_of_all[0]), -warp_max(-own_of_all[1]))
    begin = -warp_max(-first)
    end = warp_max(last)
    while begin < end:
        # Broad phase: every lane tests one chunk. A CPU, of one lane, tests groups first (10,500 vertices:
        # 9.0 -> 3.2 ms).
        found = int(0)
        step = int(wp.block_dim())
        if wp.block_dim() == 1 and begins_far_group(begin, low, high, contacts):
            step = GROUP
        elif begin + lane < end:
            found = chunk_in_box(begin + lane, low, high, own_of_all, mesh, contacts)
        chunks = warp_ballot(found)
        while chunks != 0:
            chunk = begin + lowest_bit(chunks)
            chunks &= chunks - 1
            close = int(0)
            if chunk >= first and chunk < last:
                close = close_quads_of_chunk(chunk, own, seeker, mesh, contacts)
            near, nearest = weigh_walls(
                chunk, close, part, near, nearest, before, seeker, touch, mesh, contacts, state
            )
        begin += step
    near, nearest = nearest_of_all(near, nearest, mesh)
    if touching == LYING:
        nearest = before
    # Most vertices touch nothing, and did not before.
    if spare or part > 0 or (nearest[0] < 0 and before[0] < 0 and before[1] < 0):
        return
    enter_walls(i, seeker.position, nearest, before, world, sculptures, mesh, contacts, state)


@wp.kernel
def order_hits(share_begin: int, mesh: Mesh, sculptures: Sculptures, contacts: Contacts):
    """Write the list of what touches every quad from the chain in which it was entered, sorted, so that sums
    do not depend on the order of threads; remember which quads have any.
    """
    q = share_begin + wp.tid()
    hit = int(contacts.hit_last[q])
    count = int(0)
    while hit >= 0:
        count += 1
        hit = contacts.hit_before[hit]
    if count == 0:
        return
    world = mesh.quad_world[q]
    contacts.pressed[sculptures.world_quad[world] + add_int(contacts.pressed_count, world, 1)] = q
    first = 2 * sculptures.world_vertex[world] + add_int(contacts.listed_count, world, count)
    hit = contacts.hit_last[q]
    for k in range(count):
        j = first + k
        while j > first and contacts.hits[wp.max(j - 1, first)] > hit:
            contacts.hits[j] = contacts.hits[j - 1]
            j -= 1
        contacts.hits[j] = hit
        hit = contacts.hit_before[hit]
    contacts.hit_first[q] = first
    contacts.hit_count[q] = count
