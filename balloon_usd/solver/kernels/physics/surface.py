"""The surface as the search for walls sees it: what every quad reaches, and the widths of rings."""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import Touch
from balloon_usd.solver.kernels.arrays.shared import Balloons, Contacts, Hands, Mesh, State
from balloon_usd.solver.kernels.device.array_access import int_at, vec3_at, vec4i_at
from balloon_usd.solver.kernels.device.chunk_rows import put_in_row, put_middle
from balloon_usd.solver.kernels.device.warp_reduce import warp_max3, warp_sum
from balloon_usd.solver.kernels.physics.patch import SIDE_SLIP

GROUP = wp.constant(16)
"""Chunks to a group, whose bounding box a CPU tests before theirs."""
FAR = wp.constant(1.0e6)
"""Farther than any wall, m."""


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


@wp.func
def farthest(middle: wp.vec3, x0: wp.vec3, x1: wp.vec3, x2: wp.vec3, x3: wp.vec3):
    """Return how far the farthest of four corners is from a middle (m)."""
    return wp.max(
        wp.max(wp.length(x0 - middle), wp.length(x1 - middle)),
        wp.max(wp.length(x2 - middle), wp.length(x3 - middle)),
    )


@wp.kernel
def chunk_surface(
    share_begin: int,
    touch: Touch,
    mesh: Mesh,
    balloons: Balloons,
    hands: Hands,
    contacts: Contacts,
    state: State,
):
    """Write the middle (m), the vector area (m2) and the reach (m) of every quad, and the lowest and the
    highest coordinates (m) of what the quads of a chunk reach; nothing touches them yet, and the lists of
    every sculpture are empty. A warp of lanes each on a GPU.
    """
    group, lane = wp.tid()
    chunk = share_begin + group
    if lane == 0 and chunk < contacts.pair_count.shape[0]:
        contacts.pair_count[chunk] = 0
        contacts.pressed_count[chunk] = 0
        contacts.listed_count[chunk] = 0
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
        corner = farthest(middle, x0, x1, x2, x3)
        contacts.quad_middle[q] = middle
        contacts.quad_area[q] = area
        contacts.quad_velocity[q] = going
        place = q - mesh.chunk_quad[chunk]
        put_middle(contacts.reach_rows, chunk, place, middle)
        put_in_row(contacts.reach_rows, chunk, 3, place, corner + beside)
        put_in_row(contacts.reach_rows, chunk, 4, place, above)
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


@wp.kernel
def group_chunks(contacts: Contacts):
    """Write the bounding box (m) of what every group of chunks reaches."""
    group = wp.tid()
    high = wp.vec3(-FAR)
    low = wp.vec3(FAR)
    for chunk in range(GROUP * group, wp.min(GROUP * (group + 1), contacts.chunk_low.shape[0])):
        high = wp.max(high, contacts.chunk_high[chunk])
        low = wp.min(low, contacts.chunk_low[chunk])
    contacts.group_low[group] = low
    contacts.group_high[group] = high


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
