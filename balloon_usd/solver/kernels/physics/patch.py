"""Bilinear patches: where on a quad a point is nearest to it."""

import warp as wp

SIDE_SLIP = wp.constant(0.25)
"""How far beside a quad, in lengths of its side, its plane still holds a vertex."""


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
