"""Rays and balls: the particles of air."""

import warp as wp


@wp.struct
class Balls:
    """Balls, and a tree of their boxes to find them by."""

    tree: wp.uint64
    count: int
    centres: wp.array[wp.vec3]
    radii: wp.array[wp.float32]
    colors: wp.array[wp.vec3]


@wp.struct
class BallHit:
    """The first ball along a ray, -1 when there is none, and how far away it is (m)."""

    ball: int
    distance: float


@wp.func
def first_ball(balls: Balls, origin: wp.vec3, ray: wp.vec3, reach: float) -> BallHit:
    """Return the first ball that a unit ray enters within its reach (m)."""
    found = BallHit()
    found.ball = -1
    found.distance = reach
    if balls.count == 0:
        return found
    query = wp.bvh_query_ray(balls.tree, origin, ray)
    ball = wp.int32(0)
    while wp.bvh_query_next(query, ball, found.distance):
        to_ball = balls.centres[ball] - origin
        along = wp.dot(to_ball, ray)
        beside = wp.length_sq(to_ball - along * ray)
        within = balls.radii[ball] * balls.radii[ball] - beside
        if within > 0.0:
            distance = along - wp.sqrt(within)
            if distance > 0.0 and distance < found.distance:
                found.ball = ball
                found.distance = distance
    return found
