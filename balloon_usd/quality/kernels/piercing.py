"""Edges that pierce faces, on a device: boxes in single precision, then the exact test in integers.

Faces are quads of two triangles, (a, b, c) and (a, c, d). Places are those of `quality.crossings`: vertices
rounded to its lattice, on which all products fit 64 bits.
"""

import warp as wp

place = wp.types.vector(length=3, dtype=wp.int64)
"""A vertex on the lattice."""

ROUNDING = 1.0e-6
"""How much wider boxes are than their faces, as a share of the distance from the origin: single precision
has 6e-8.
"""


@wp.struct
class Surface:
    """What does not change from frame to frame."""

    quads: wp.array[wp.vec4i]
    """Faces, (F,)."""
    edges: wp.array[wp.vec2i]
    """Ends of all edges and diagonals, (E,), those of each face together."""
    owned: wp.array[wp.vec2i]
    """First of the edges of each face, and the one after its last, (F,); every edge has one face."""


@wp.kernel(enable_backward=False)
def measure_faces(points: wp.array[wp.vec3], surface: Surface, widest: wp.array[wp.float64]):
    """Find the longest side of the boxes round all triangles, m."""
    quad = surface.quads[wp.tid()]
    a, b, c, d = points[quad[0]], points[quad[1]], points[quad[2]], points[quad[3]]
    wide = wp.max(
        widest_side(wp.min(wp.min(a, b), c), wp.max(wp.max(a, b), c)),
        widest_side(wp.min(wp.min(a, c), d), wp.max(wp.max(a, c), d)),
    )
    # Most faces are narrower than one before, and need no atomic.
    if wide > widest[0]:
        wp.atomic_max(widest, 0, wide)


@wp.func
def widest_side(low: wp.vec3, high: wp.vec3):
    """Return the longest side of a box; differences of single precision are exact in double."""
    x = wp.float64(high[0]) - wp.float64(low[0])
    y = wp.float64(high[1]) - wp.float64(low[1])
    z = wp.float64(high[2]) - wp.float64(low[2])
    return wp.max(wp.max(x, y), z)


@wp.kernel(enable_backward=False)
def round_points(points: wp.array[wp.vec3], per_unit: wp.float64, places: wp.array[place]):
    """Round vertices to the lattice; halves go to even numbers."""
    i = wp.tid()
    p = points[i]
    places[i] = place(
        wp.int64(wp.rint(wp.float64(p[0]) * per_unit)),
        wp.int64(wp.rint(wp.float64(p[1]) * per_unit)),
        wp.int64(wp.rint(wp.float64(p[2]) * per_unit)),
    )


@wp.kernel(enable_backward=False)
def box_faces(
    points: wp.array[wp.vec3],
    surface: Surface,
    unit: float,
    lows: wp.array[wp.vec3],
    highs: wp.array[wp.vec3],
):
    """Put a box round every face that holds its places too: those are half a unit away at most."""
    f = wp.tid()
    quad = surface.quads[f]
    a, b, c, d = points[quad[0]], points[quad[1]], points[quad[2]], points[quad[3]]
    low = wp.min(wp.min(a, b), wp.min(c, d))
    high = wp.max(wp.max(a, b), wp.max(c, d))
    more = wp.vec3(unit + ROUNDING * wp.max(wp.max(wp.abs(low)), wp.max(wp.abs(high))))
    lows[f] = low - more
    highs[f] = high + more


@wp.kernel(enable_backward=False)
def find_pierced(
    tree: wp.uint64,
    lows: wp.array[wp.vec3],
    highs: wp.array[wp.vec3],
    places: wp.array[place],
    surface: Surface,
    count: wp.array[wp.int32],
    found: wp.array[wp.vec2i],
):
    """Write down all pairs of an edge and a triangle that it pierces, in any order, and count them."""
    own = wp.tid()
    span = surface.owned[own]
    query = wp.bvh_query_aabb(tree, lows[own], highs[own])
    other = int(0)
    while wp.bvh_query_next(query, other):
        if other == own:
            continue
        quad = surface.quads[other]
        a, b, c, d = places[quad[0]], places[quad[1]], places[quad[2]], places[quad[3]]
        low = wp.min(wp.min(a, b), wp.min(c, d))
        high = wp.max(wp.max(a, b), wp.max(c, d))
        for e in range(span[0], span[1]):
            ends = surface.edges[e]
            if is_corner(quad, ends[0]) or is_corner(quad, ends[1]):
                continue
            p, q = places[ends[0]], places[ends[1]]
            # Numbers are small enough for the test where boxes overlap.
            if apart(wp.min(p, q), wp.max(p, q), low, high):
                continue
            if pierces(p, q, a, b, c):
                write_down(e, other, count, found)
            if pierces(p, q, a, c, d):
                write_down(e, other + surface.quads.shape[0], count, found)


@wp.func
def is_corner(quad: wp.vec4i, vertex: int):
    """Tell whether a vertex is a corner of a face."""
    return quad[0] == vertex or quad[1] == vertex or quad[2] == vertex or quad[3] == vertex


@wp.func
def apart(low: place, high: place, other_low: place, other_high: place):
    """Tell whether two boxes neither overlap nor touch."""
    return (
        low[0] > other_high[0]
        or low[1] > other_high[1]
        or low[2] > other_high[2]
        or high[0] < other_low[0]
        or high[1] < other_low[1]
        or high[2] < other_low[2]
    )


@wp.func
def pierces(p: place, q: place, a: place, b: place, c: place):
    """Tell whether the edge from p to q passes through the inside of a triangle."""
    normal = cross(b - a, c - a)
    if side(dot(normal, p - a)) * side(dot(normal, q - a)) >= 0:
        return False
    along = q - p
    first = side(dot(cross(along, a - p), b - p))
    if first == 0 or first != side(dot(cross(along, b - p), c - p)):
        return False
    return first == side(dot(cross(along, c - p), a - p))


@wp.func
def side(volume: wp.int64):
    """Return the sign of a number."""
    if volume > wp.int64(0):
        return 1
    if volume < wp.int64(0):
        return -1
    return 0


@wp.func
def dot(u: place, v: place):
    """Return the scalar product."""
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


@wp.func
def cross(u: place, v: place):
    """Return the vector product."""
    return place(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


@wp.func
def write_down(edge: int, triangle: int, count: wp.array[wp.int32], found: wp.array[wp.vec2i]):
    """Keep a pair, if there is room for it; the count tells how much room it takes."""
    slot = wp.atomic_add(count, 0, 1)
    if slot < found.shape[0]:
        found[slot] = wp.vec2i(edge, triangle)
