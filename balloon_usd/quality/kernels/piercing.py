"""Edges that may pierce faces, on a device: boxes in single precision, then the sides of planes in double.

Faces are quads of two triangles, (a, b, c) and (a, c, d). What rounding could decide is found, too.
"""

import warp as wp

from balloon_usd.quality.orientation import ROUNDING

MOST_ROUNDING = wp.constant(wp.float64(ROUNDING))
IN_PLANE = wp.constant(2)
"""Side of a point that certainly lies in a plane."""


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
def box_faces(points: wp.array[wp.vec3], surface: Surface, lows: wp.array[wp.vec3], highs: wp.array[wp.vec3]):
    """Put a box round every face."""
    f = wp.tid()
    quad = surface.quads[f]
    a, b, c, d = points[quad[0]], points[quad[1]], points[quad[2]], points[quad[3]]
    lows[f] = wp.min(wp.min(a, b), wp.min(c, d))
    highs[f] = wp.max(wp.max(a, b), wp.max(c, d))


@wp.kernel(enable_backward=False)
def find_pierced(
    tree: wp.uint64,
    lows: wp.array[wp.vec3],
    highs: wp.array[wp.vec3],
    points: wp.array[wp.vec3],
    surface: Surface,
    count: wp.array[wp.int32],
    found: wp.array[wp.vec2i],
):
    """Write down all pairs of an edge and a triangle that it may pierce, in any order, and count them."""
    own = wp.tid()
    span = surface.owned[own]
    query = wp.bvh_query_aabb(tree, lows[own], highs[own])
    other = int(0)
    while wp.bvh_query_next(query, other):
        if other == own:
            continue
        quad = surface.quads[other]
        for e in range(span[0], span[1]):
            ends = surface.edges[e]
            if is_corner(quad, ends[0]) or is_corner(quad, ends[1]):
                continue
            p, q = points[ends[0]], points[ends[1]]
            if apart(wp.min(p, q), wp.max(p, q), lows[other], highs[other]):
                continue
            a, b, c, d = points[quad[0]], points[quad[1]], points[quad[2]], points[quad[3]]
            if may_pierce(p, q, a, b, c):
                write_down(e, other, count, found)
            if quad[2] != quad[3] and may_pierce(p, q, a, c, d):
                write_down(e, other + surface.quads.shape[0], count, found)


@wp.func
def is_corner(quad: wp.vec4i, vertex: int):
    """Tell whether a vertex is a corner of a face."""
    return quad[0] == vertex or quad[1] == vertex or quad[2] == vertex or quad[3] == vertex


@wp.func
def apart(low: wp.vec3, high: wp.vec3, other_low: wp.vec3, other_high: wp.vec3):
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
def may_pierce(p: wp.vec3, q: wp.vec3, a: wp.vec3, b: wp.vec3, c: wp.vec3):
    """Tell whether the edge from p to q passes through the inside of a triangle, as far as rounding shows."""
    below, above = side(a, b, c, p), side(a, b, c, q)
    if below == IN_PLANE or above == IN_PLANE or below * above > 0:
        return False
    first = side(p, q, a, b)
    second = side(p, q, b, c)
    if first == IN_PLANE or second == IN_PLANE or first * second < 0:
        return False
    third = side(p, q, c, a)
    return third != IN_PLANE and first * third >= 0 and second * third >= 0


@wp.func
def side(a: wp.vec3, b: wp.vec3, c: wp.vec3, point: wp.vec3):
    """Return on which side of a plane a point lies: 1, -1, in it, or 0 where rounding could decide."""
    u, v, w = difference(a, b), difference(a, c), difference(a, point)
    volume = wp.dot(wp.cross(u, v), w)
    size = wp.dot(crossed_sizes(wp.abs(u), wp.abs(v)), wp.abs(w))
    if size == wp.float64(0.0):
        return IN_PLANE
    if wp.abs(volume) <= MOST_ROUNDING * size:
        return 0
    return wp.where(volume > wp.float64(0.0), 1, -1)


@wp.func
def difference(start: wp.vec3, end: wp.vec3):
    """Return the way from a point to another in double precision."""
    return wp.vec3d(
        wp.float64(end[0]) - wp.float64(start[0]),
        wp.float64(end[1]) - wp.float64(start[1]),
        wp.float64(end[2]) - wp.float64(start[2]),
    )


@wp.func
def crossed_sizes(u: wp.vec3d, v: wp.vec3d):
    """Return the sums of the products in a vector product, whose factors have no signs."""
    return wp.vec3d(u[1] * v[2] + u[2] * v[1], u[2] * v[0] + u[0] * v[2], u[0] * v[1] + u[1] * v[0])


@wp.func
def write_down(edge: int, triangle: int, count: wp.array[wp.int32], found: wp.array[wp.vec2i]):
    """Keep a pair, if there is room for it; the count tells how much room it takes."""
    slot = wp.atomic_add(count, 0, 1)
    if slot < found.shape[0]:
        found[slot] = wp.vec2i(edge, triangle)
