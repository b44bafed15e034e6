"""Contact of walls: broad phase over bounding boxes of chunks of quads, narrow phase against bilinear
patches, penalty forces and Coulomb friction.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Forces
from balloon_usd.solver.kernels.arrays.rows import Touch
from balloon_usd.solver.kernels.arrays.shared import Balloons, Contacts, Hands, Mesh, Sculptures, State
from balloon_usd.solver.kernels.device.array_access import (
    float_at,
    int_at,
    int_in,
    vec2_at,
    vec3_at,
    vec4i_at,
)
from balloon_usd.solver.kernels.device.coherent_load import coherent_vec2, coherent_vec3
from balloon_usd.solver.kernels.device.soa import load_soa, store_soa
from balloon_usd.solver.kernels.device.warp_reduce import (
    lowest_bit,
    warp_ballot,
    warp_max,
    warp_max3,
    warp_sum,
)
from balloon_usd.solver.kernels.physics.motion import LYING

FACING = wp.constant(-0.1)
"""Walls face each other when the dot product of their outward normals is below this."""
DEPTH_LIMIT = wp.constant(0.6)
"""Deepest overlap taken for a contact, in local tube radii: beyond it the other wall is the tube's far
side.
"""
SIDE_SLIP = wp.constant(0.25)
"""How far beside a quad, in lengths of its side, its plane still holds a vertex."""
STICK = wp.constant(0.5)
"""Tangential stiffness of a contact, in normal stiffnesses."""
STABLE = wp.constant(0.25)
"""Largest contact stiffness, in the lightest of the vertex masses per squared time step."""
FIRM = wp.constant(2.5)
"""Pressure that each of two walls adds at zero distance, in the higher gauge pressure behind them: at rest a
fifth of the offset is used up.
"""
DEEPEST = wp.constant(2.0)
"""Overlap beyond which walls are pressed no harder, in offsets: what has gone through is led out, not flung
(scissors with ears of 3 cm flew apart).
"""
CROWD = wp.constant(0.5)
"""Share of the vertices that touch a quad, above 1, by which that limit is divided: two share one limit."""
OWN = wp.constant(256)
"""Most quads before a vertex, and after it, that are known as its own."""
OPPOSITE = wp.constant(-0.3)
"""Walls are on opposite sides of a tube when the dot product of their unstressed normals is below this."""
INSIDE = wp.constant(0.5)
"""Distance at which the inside of a wall begins to press on itself, in that of the outside."""
FAR = wp.constant(1.0e6)
"""Farther than any wall, m."""
NONE = wp.constant(1 << 30)
"""Index beyond any other."""
ROUNDED = wp.constant(1.001)
"""Inflation of a warp's bounding box, so that rounding culls nothing that is within reach of one of its
lanes.
"""
NORMAL_DAMPING = wp.constant(0.3)
"""Damping of the approach, as a share of what would stop the vertex in one substep."""


@wp.func
def velocity_of_spin(i: int, p: wp.vec3, hands: Hands):
    """Return the velocity (m/s) that hands who turn a vertex give it where it is (m), besides its own."""
    velocity = wp.vec3(0.0)
    spin = int_at(hands.vertex_spin, i)
    if spin > 0:
        turn = hands.spins[spin - 1]
        velocity = wp.cross(turn.rate * turn.axis, p - turn.point) + turn.drift
    return velocity


@wp.func
def velocity_of_quad(c: wp.vec4i, middle: wp.vec3, hands: Hands, v: wp.array[wp.vec3]):
    """Return the velocity (m/s) of the middle (m) of a quad; `c`: its vertices, which hands turn together."""
    own = 0.25 * (vec3_at(v, c[0]) + vec3_at(v, c[1]) + vec3_at(v, c[2]) + vec3_at(v, c[3]))
    return own + velocity_of_spin(c[0], middle, hands)


@wp.kernel
def chunk_surface(
    touch: Touch, mesh: Mesh, balloons: Balloons, hands: Hands, contacts: Contacts, state: State
):
    """Write the middle (m), the vector area (m2) and the reach (m) of every quad, and the lowest and the
    highest coordinates (m) of what the quads of a chunk reach; nothing touches them yet. A warp of lanes each
    on a GPU.
    """
    chunk, lane = wp.tid()
    high = wp.vec3(-FAR)
    low = wp.vec3(FAR)
    for q in range(mesh.chunk_quad[chunk] + lane, mesh.chunk_quad[chunk + 1], wp.block_dim()):
        c = mesh.quads[q]
        x0 = state.x[c[0]]
        x1 = state.x[c[1]]
        x2 = state.x[c[2]]
        x3 = state.x[c[3]]
        middle = 0.25 * (x0 + x1 + x2 + x3)
        area = 0.5 * wp.cross(x2 - x0, x3 - x1)
        size = wp.length(area)
        b = mesh.quad_balloon[q]
        going = velocity_of_quad(c, middle, hands, state.v)
        above = balloons.contact_arc[b] * size + touch.ahead * wp.length(going)
        beside = SIDE_SLIP * wp.sqrt(size)
        corner = wp.max(
            wp.max(wp.length(x0 - middle), wp.length(x1 - middle)),
            wp.max(wp.length(x2 - middle), wp.length(x3 - middle)),
        )
        contacts.quad_middle[q] = middle
        contacts.quad_area[q] = area
        contacts.quad_velocity[q] = going
        contacts.quad_reach[q] = wp.vec2(corner + beside, above)
        contacts.hit_count[q] = 0
        contacts.hit_last[q] = -1
        # So much farther than the least reach of a vertex: above and beside at once.
        least = balloons.contact_offset[b] + touch.margin
        around = wp.vec3(wp.length(wp.vec2(beside, above + least)) - least)
        high = wp.max(high, wp.max(wp.max(x0, x1), wp.max(x2, x3)) + around)
        low = wp.min(low, wp.min(wp.min(x0, x1), wp.min(x2, x3)) - around)
    high = warp_max3(high)
    low = -warp_max3(-low)
    if lane == 0:
        contacts.chunk_low[chunk] = low
        contacts.chunk_high[chunk] = high


@wp.func
def surface_of_vertex(i: int, corners: wp.array[wp.vec4i], quad_area: wp.array[wp.vec3]):
    """Return the outward vector area (m2) of the wall about a vertex, and the vertex's share of it (m2)."""
    total = wp.vec3(0.0)
    size = float(0.0)
    row = int(i)
    while row >= 0:
        slots = vec4i_at(corners, row)
        for k in range(4):
            if slots[k] >= 0:
                a = vec3_at(quad_area, slots[k] // 4)
                total += a
                size += 0.25 * wp.length(a)
        row = -2 - slots[3]
    return total, size


@wp.kernel
def ring_radii(
    ring_first: wp.array[int],
    ring_around: wp.array[int],
    x: wp.array[wp.vec3],
    ring_radius: wp.array[float],
):
    """Write the radius (m) of every ring, its girth over 2 pi; a warp of lanes each on a GPU."""
    r, lane = wp.tid()
    girth = float(0.0)
    first = ring_first[r]
    n = ring_around[r]
    for k in range(lane, n, wp.block_dim()):
        girth += wp.length(x[first + k] - x[first + (k + n - 1) % n])
    girth = warp_sum(girth)
    if lane == 0:
        ring_radius[r] = girth / (2.0 * wp.pi)


@wp.func
def nearer_on_patch(x0: wp.vec3, x1: wp.vec3, x2: wp.vec3, x3: wp.vec3, p: wp.vec3, place: wp.vec2):
    """Return the coordinates (-1/2 .. 1/2) of a point of a bilinear patch that is nearer to p than one at
    hand: a step of Gauss and Newton.
    """
    u = place[0]
    w = place[1]
    a = 0.5 * (x1 - x0 + x2 - x3)
    b = 0.5 * (x3 - x0 + x2 - x1)
    h = x0 - x1 + x2 - x3
    r = 0.25 * (x0 + x1 + x2 + x3) - p + u * a + w * b + u * w * h
    du = a + w * h
    dw = b + u * h
    aa = wp.dot(du, du)
    bb = wp.dot(dw, dw)
    ab = wp.dot(du, dw)
    det = wp.max(aa * bb - ab * ab, 1.0e-20)
    ra = wp.dot(r, du)
    rb = wp.dot(r, dw)
    return wp.vec2(
        wp.clamp(u - (bb * ra - ab * rb) / det, -0.5, 0.5),
        wp.clamp(w - (aa * rb - ab * ra) / det, -0.5, 0.5),
    )


@wp.func
def nearest_on_patch(x0: wp.vec3, x1: wp.vec3, x2: wp.vec3, x3: wp.vec3, p: wp.vec3):
    """Return the coordinates (-1/2 .. 1/2) of the point of a bilinear patch nearest to p."""
    place = wp.vec2(0.0, 0.0)
    for _ in range(3):
        place = nearer_on_patch(x0, x1, x2, x3, p, place)
    return place


@wp.func
def patch_shares(uw: wp.vec2):
    """Return how a point of a bilinear patch is shared by its four corners."""
    u = uw[0]
    w = uw[1]
    return wp.vec4((0.5 - u) * (0.5 - w), (0.5 + u) * (0.5 - w), (0.5 + u) * (0.5 + w), (0.5 - u) * (0.5 + w))


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


@wp.struct
class Seeker:
    """A vertex that looks for walls that it may touch."""

    balloon: int
    bubble: int
    """Its segment; a ring between two bubbles belongs to neither."""
    place: wp.vec3
    """Its unstressed place, m."""
    apart: float
    """Unstressed distance within which the wall of its bubble never meets it, m."""
    outward: wp.vec3
    """Unstressed outward direction; 0 where the inside of the wall never meets itself."""
    across: float
    """Unstressed distance along its bubble within which the inside of the wall may meet itself, m."""
    position: wp.vec3
    """m"""
    velocity: wp.vec3
    """m/s"""
    normal: wp.vec3
    """Its outward unit normal."""
    depth: float
    """Deepest overlap taken for a contact on its side, m."""
    offset: float
    """Distance at which the smallest faces begin to press on it, m."""
    arc: float
    """Growth of that distance with the area of a face, 1/m."""
    reach: float
    """Distance within which it looks at what quads reach, m."""


@wp.func
def seeker_of(i: int, touch: Touch, mesh: Mesh, balloons: Balloons):
    """Return a vertex with where it belongs; it looks nowhere yet."""
    seeker = Seeker()
    seeker.balloon = mesh.vertex_balloon[i]
    seeker.bubble = mesh.vertex_segment[i]
    seeker.place = mesh.vertex_place[i]
    seeker.apart = touch.apart * balloons.balloon_radius[seeker.balloon]
    seeker.outward = mesh.vertex_outward[i]
    seeker.across = touch.across * balloons.balloon_radius[seeker.balloon]
    seeker.offset = balloons.contact_offset[seeker.balloon]
    seeker.arc = balloons.contact_arc[seeker.balloon]
    return seeker


@wp.func
def opposite(q: int, seeker: Seeker, mesh: Mesh):
    """Return whether a quad is on the other side of a vertex's own bubble: there it is their insides that may
    meet.
    """
    away = wp.max(wp.abs(vec3_at(mesh.quad_place, q) - seeker.place))
    return (
        int_at(mesh.quad_segment, q) == seeker.bubble
        and away < seeker.across
        and wp.dot(seeker.outward, vec3_at(mesh.quad_outward, q)) < OPPOSITE
    )


@wp.func
def may_meet(q: int, seeker: Seeker, mesh: Mesh):
    """Return whether a quad may ever touch a vertex."""
    return (
        int_at(mesh.quad_balloon, q) != seeker.balloon
        or (seeker.bubble >= 0 and int_at(mesh.quad_segment, q) != seeker.bubble)
        or wp.max(wp.abs(vec3_at(mesh.quad_place, q) - seeker.place)) > seeker.apart
        or opposite(q, seeker, mesh)
    )


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
    if wp.dot(face, seeker.normal) < FACING and may_meet(q, seeker, mesh):
        height = wp.dot(d, face)
        limit = wp.min(seeker.depth, DEPTH_LIMIT * float_at(contacts.ring_radius, int_at(mesh.quad_ring, q)))
        going = seeker.velocity - vec3_at(contacts.quad_velocity, q)
        watched = touch.margin + touch.ahead * wp.length(going)
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
    seeker: Seeker,
    touch: Touch,
    mesh: Mesh,
    contacts: Contacts,
    state: State,
):
    """Return the distances (m) of the two nearest quads of different bubbles, and these, after one more."""
    d = seeker.position - vec3_at(contacts.quad_middle, q)
    distance = distance_of_wall(q, d, seeker, touch, mesh, contacts, state)
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
def close_quads(base: int, first: int, end: int, seeker: Seeker, contacts: Contacts):
    """Return the bits, counted from quad `base`, of those quads that are within reach of a vertex."""
    bits = int(0)
    for q in range(first, end):
        d = seeker.position - vec3_at(contacts.quad_middle, q)
        reach = vec2_at(contacts.quad_reach, q)
        above = seeker.reach + reach[1]
        if wp.dot(d, d) < reach[0] * reach[0] + above * above:
            bits |= 1 << (q - base)
    return bits


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
        close = close_quads(base, first, end, seeker, contacts)
    return close


@wp.func
def enter_walls(
    i: int, p: wp.vec3, found: wp.vec2i, before: wp.vec2i, mesh: Mesh, contacts: Contacts, state: State
):
    """Enter the walls that a vertex was found to touch in their lists, with what it has slipped on those that
    it touched before.
    """
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
            contacts.hit_before[2 * i + k] = wp.atomic_exch(contacts.hit_last, found[k], 2 * i + k)
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
    seeker.reach = seeker.offset + touch.margin + touch.ahead * wp.length(seeker.velocity)
    return seeker


@wp.kernel
def find_walls(
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

    On a GPU a warp searches for 32 neighbouring vertices: a broad phase culls chunks by the bounding box of
    the whole warp, a narrow phase measures each lane's own candidates.
    """
    group, lane = wp.tid()
    i = group * wp.block_dim() + lane
    spare = i >= state.x.shape[0]
    i = wp.min(i, state.x.shape[0] - 1)
    outward, size = surface_of_vertex(i, mesh.corners, contacts.quad_area)
    seeker = seeker_at(i, wp.normalize(outward), touch, mesh, balloons, hands, contacts, state)
    contacts.normal[i] = seeker.normal
    contacts.area[i] = size
    own = contacts.vertex_own[i]
    world = balloons.balloon_world[seeker.balloon]
    near = wp.vec2(FAR, FAR)
    nearest = wp.vec2i(-1, -1)
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
        # Broad phase: every lane tests one chunk.
        found = int(0)
        if begin + lane < end:
            found = chunk_in_box(begin + lane, low, high, own_of_all, mesh, contacts)
        chunks = warp_ballot(found)
        while chunks != 0:
            chunk = begin + lowest_bit(chunks)
            chunks &= chunks - 1
            close = int(0)
            if chunk >= first and chunk < last:
                close = close_quads_of_chunk(chunk, own, seeker, mesh, contacts)
            base = int_at(mesh.chunk_quad, chunk)
            # Narrow phase: every lane tests one candidate a round, until no lane has any left.
            while warp_ballot(wp.where(close != 0, 1, 0)) != 0:
                if close != 0:
                    q = base + lowest_bit(close)
                    near, nearest = weigh_wall(q, near, nearest, seeker, touch, mesh, contacts, state)
                    close &= close - 1
        begin += wp.block_dim()
    before = wp.vec2i(int_in(contacts.target, i, 0), int_in(contacts.target, i, 1))
    if touching == LYING:
        nearest = before
    # Most vertices touch nothing, and did not before.
    if spare or (nearest[0] < 0 and before[0] < 0 and before[1] < 0):
        return
    enter_walls(i, seeker.position, nearest, before, mesh, contacts, state)
    for k in range(2):
        if nearest[k] >= 0:
            contacts.pairs[
                2 * sculptures.world_vertex[world] + wp.atomic_add(contacts.pair_count, world, 1)
            ] = 2 * i + k


@wp.kernel
def order_hits(mesh: Mesh, sculptures: Sculptures, contacts: Contacts):
    """Write the list of what touches every quad from the chain in which it was entered, sorted, so that sums
    do not depend on the order of threads; remember which quads have any.
    """
    q = wp.tid()
    hit = int(contacts.hit_last[q])
    count = int(0)
    while hit >= 0:
        count += 1
        hit = contacts.hit_before[hit]
    if count == 0:
        return
    world = mesh.quad_world[q]
    contacts.pressed[sculptures.world_quad[world] + wp.atomic_add(contacts.pressed_count, world, 1)] = q
    first = 2 * sculptures.world_vertex[world] + wp.atomic_add(contacts.listed_count, world, count)
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


@wp.func
def pressure_behind(i: int, q: int, mesh: Mesh, segment_pressure: wp.array[float]):
    """Return the higher of the gauge pressures (Pa) behind a vertex and behind a quad."""
    behind = float_at(segment_pressure, int_at(mesh.quad_segment, q))
    bubble = int_at(mesh.vertex_segment, i)
    if bubble >= 0:
        behind = wp.max(behind, float_at(segment_pressure, bubble))
    return behind


@wp.func
def limits_of_pair(
    pair: int,
    touch: Touch,
    dt: float,
    mesh: Mesh,
    balloons: Balloons,
    contacts: Contacts,
    segment_pressure: wp.array[float],
):
    """Return what stays constant between two searches for a vertex that touches a quad: the quad's vertices,
    the stiffness (N/m), the damping (N s/m), the friction, and the distance at which it is pressed (m), below
    0 where it is the insides that touch.
    """
    i = pair >> 1
    q = int_in(contacts.target, i, pair & 1)
    c = vec4i_at(mesh.quads, q)
    lightest = wp.min(
        float_at(mesh.mass, i),
        wp.min(
            wp.min(float_at(mesh.mass, c[0]), float_at(mesh.mass, c[1])),
            wp.min(float_at(mesh.mass, c[2]), float_at(mesh.mass, c[3])),
        ),
    )
    crowd = wp.max(CROWD * float(int_at(contacts.hit_count, q)), 1.0)
    balloon = int_at(mesh.vertex_balloon, i)
    face = wp.length(vec3_at(contacts.quad_area, q))
    offset = float_at(balloons.contact_offset, balloon) + float_at(balloons.contact_arc, balloon) * face
    side = float(1.0)
    if opposite(q, seeker_of(i, touch, mesh, balloons), mesh):
        offset = INSIDE * float_at(balloons.contact_offset, balloon)
        side = -1.0
    most_pressure = wp.max(touch.pressure, FIRM * pressure_behind(i, q, mesh, segment_pressure))
    stiffness = wp.min(
        most_pressure * float_at(contacts.area, i) / offset, STABLE * lightest / (dt * dt * crowd)
    )
    damping = NORMAL_DAMPING * lightest / (dt * crowd)
    return c, wp.vec4(stiffness, damping, float_at(balloons.friction, balloon), side * offset)


@wp.func
def press_wall(
    pair: int,
    c: wp.vec4i,
    limits: wp.vec4,
    dt: float,
    shared: int,
    contacts: Contacts,
    state: State,
):
    """Write the contact force (N) on a vertex that touches a quad, and where on the quad.

    A penalty along the quad's normal with damping; across it Coulomb friction by an elastic bristle, whose
    deflection is `contacts.slip` and is cut where the bristle slides.

    `pair`: twice the vertex, and which of its walls; `c`, `limits`: of `limits_of_pair`.
    """
    i = pair >> 1
    k = pair & 1
    p = coherent_vec3(state.x, i, shared)
    x0 = coherent_vec3(state.x, c[0], shared)
    x1 = coherent_vec3(state.x, c[1], shared)
    x2 = coherent_vec3(state.x, c[2], shared)
    x3 = coherent_vec3(state.x, c[3], shared)
    # Prefetch: loaded before the test that may not need them.
    velocity = coherent_vec3(state.v, i, shared)
    v0 = coherent_vec3(state.v, c[0], shared)
    v1 = coherent_vec3(state.v, c[1], shared)
    v2 = coherent_vec3(state.v, c[2], shared)
    v3 = coherent_vec3(state.v, c[3], shared)
    before = contacts.slip[i, k]
    # Warm start: it slides little in a substep, so one iteration is enough.
    place = nearer_on_patch(x0, x1, x2, x3, p, vec2_at(contacts.contact_place, pair))
    s = patch_shares(place)
    gap = p - (s[0] * x0 + s[1] * x1 + s[2] * x2 + s[3] * x3)
    area = 0.5 * wp.cross(x2 - x0, x3 - x1)
    size = wp.length(area)
    face = wp.sign(limits[3]) * area / wp.max(size, 1.0e-12)
    height = wp.dot(gap, face)
    offset = wp.abs(limits[3])
    overlap = offset - height
    f = wp.vec3(0.0)
    deflection = wp.vec3(0.0)
    if overlap > 0.0 and wp.length(gap - height * face) < 2.0 * SIDE_SLIP * wp.sqrt(size):
        stiffness = limits[0]
        going = velocity - (s[0] * v0 + s[1] * v1 + s[2] * v2 + s[3] * v3)
        approach = wp.dot(going, face)
        near = wp.min(overlap / offset, 1.0)
        push = wp.max(stiffness * wp.min(overlap, DEEPEST * offset) - limits[1] * near * approach, 0.0)
        along = going - approach * face
        deflection = before + along * dt
        deflection = deflection - wp.dot(deflection, face) * face
        tangential = STICK * stiffness
        most = limits[2] * push / tangential
        length = wp.length(deflection)
        if length > most:
            deflection = deflection * (most / length)
        f = push * face - tangential * deflection
    contacts.slip[i, k] = deflection
    store_soa(contacts.contact_force, i, k, f)
    contacts.contact_place[pair] = place


@wp.func
def balancing_turn(r0: wp.vec3, r1: wp.vec3, r2: wp.vec3, r3: wp.vec3, couple: wp.vec3):
    """Return the vector whose cross products with a quad's corners balance a couple (N m): that of contacts
    across a gap, where the vertex feels a force at one end and the quad its opposite at the other.
    """
    square = wp.dot(r0, r0) + wp.dot(r1, r1) + wp.dot(r2, r2) + wp.dot(r3, r3)
    spread = wp.outer(r0, r0) + wp.outer(r1, r1) + wp.outer(r2, r2) + wp.outer(r3, r3)
    inertia = square * wp.identity(n=3, dtype=float) - spread
    return wp.inverse(inertia) * couple


@wp.func
def press_quad_back(q: int, shared: int, mesh: Mesh, contacts: Contacts, forces: Forces, state: State):
    """Take from the corners of a quad what the vertices that touch it felt, forces and torques."""
    first = int_at(contacts.hit_first, q)
    count = int_at(contacts.hit_count, q)
    c = vec4i_at(mesh.quads, q)
    x0 = coherent_vec3(state.x, c[0], shared)
    x1 = coherent_vec3(state.x, c[1], shared)
    x2 = coherent_vec3(state.x, c[2], shared)
    x3 = coherent_vec3(state.x, c[3], shared)
    middle = 0.25 * (x0 + x1 + x2 + x3)
    r0 = x0 - middle
    r1 = x1 - middle
    r2 = x2 - middle
    r3 = x3 - middle
    f0 = wp.vec3(0.0)
    f1 = wp.vec3(0.0)
    f2 = wp.vec3(0.0)
    f3 = wp.vec3(0.0)
    couple = wp.vec3(0.0)
    for k in range(count):
        hit = int_at(contacts.hits, first + k)
        f = load_soa(contacts.contact_force, hit // 2, hit % 2, shared)
        share = patch_shares(coherent_vec2(contacts.contact_place, hit, shared))
        f0 += share[0] * f
        f1 += share[1] * f
        f2 += share[2] * f
        f3 += share[3] * f
        touched = middle + share[0] * r0 + share[1] * r1 + share[2] * r2 + share[3] * r3
        couple += wp.cross(coherent_vec3(state.x, hit // 2, shared) - touched, f)
    turn = balancing_turn(r0, r1, r2, r3, couple)
    store_soa(
        forces.corner_force, q, 0, load_soa(forces.corner_force, q, 0, shared) - f0 - wp.cross(turn, r0)
    )
    store_soa(
        forces.corner_force, q, 1, load_soa(forces.corner_force, q, 1, shared) - f1 - wp.cross(turn, r1)
    )
    store_soa(
        forces.corner_force, q, 2, load_soa(forces.corner_force, q, 2, shared) - f2 - wp.cross(turn, r2)
    )
    store_soa(
        forces.corner_force, q, 3, load_soa(forces.corner_force, q, 3, shared) - f3 - wp.cross(turn, r3)
    )
