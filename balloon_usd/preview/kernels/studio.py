"""The photographer's studio: three softboxes, a bright room and a pale floor."""

import warp as wp


@wp.struct
class Studio:
    """Lights of the studio in world space; radiances are relative to a white wall at 1."""

    floor: float
    """Height of the floor (m)."""
    ahead: wp.vec3
    """Level direction in which the camera looks, towards the lit backdrop."""
    key: wp.vec3
    key_right: wp.vec3
    key_up: wp.vec3
    rim: wp.vec3
    rim_right: wp.vec3
    rim_up: wp.vec3
    top: wp.vec3
    top_right: wp.vec3
    top_up: wp.vec3
    key_radiance: float
    rim_radiance: float
    top_radiance: float


@wp.func
def smooth_step(low: float, high: float, x: float) -> float:
    """Return the cubic step from 0 at `low` to 1 at `high`."""
    t = wp.clamp((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


@wp.func
def softbox(direction: wp.vec3, centre: wp.vec3, right: wp.vec3, up: wp.vec3, edge: float) -> float:
    """Return the share 0..1 of a rounded rectangular light seen in a unit direction.

    `right` and `up` are divided by the half width and half height (as tangents) of the light.
    """
    facing = wp.dot(direction, centre)
    if facing <= 0.05:
        return 0.0
    x = wp.abs(wp.dot(direction, right) / facing)
    y = wp.abs(wp.dot(direction, up) / facing)
    # A superellipse of order 6: straight sides, round corners, one smooth edge.
    radius = wp.pow(x * x * x * x * x * x + y * y * y * y * y * y, 1.0 / 6.0)
    return 1.0 - smooth_step(1.0 - edge, 1.0 + edge, radius)


@wp.func
def room(direction: wp.vec3, ahead: wp.vec3) -> float:
    """Return the radiance of the walls, the ceiling, the floor and the backdrop, without the lamps."""
    height = direction[2]
    wall = 0.22 + 0.20 * smooth_step(-0.2, 0.9, height)
    backdrop = 0.45 * smooth_step(0.45, 1.0, wp.dot(direction, ahead))
    return wp.lerp(0.34, wall, smooth_step(-0.35, 0.05, height)) + backdrop


@wp.func
def studio_radiance(studio: Studio, direction: wp.vec3) -> float:
    """Return what a mirror ball sees of the studio in a unit direction."""
    key = softbox(direction, studio.key, studio.key_right, studio.key_up, 0.10)
    rim = softbox(direction, studio.rim, studio.rim_right, studio.rim_up, 0.25)
    top = softbox(direction, studio.top, studio.top_right, studio.top_up, 0.30)
    return (
        room(direction, studio.ahead)
        + studio.key_radiance * key
        + studio.rim_radiance * rim
        + studio.top_radiance * top
    )
