"""Which walls may ever meet, by where they are on the balloon."""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import Touch
from balloon_usd.solver.kernels.arrays.shared import Balloons, Mesh
from balloon_usd.solver.kernels.device.array_access import int_at, vec3_at

OPPOSITE = wp.constant(-0.3)
"""Walls are on opposite sides of a tube when the dot product of their unstressed normals is below this."""
INSIDE = wp.constant(0.5)
"""Distance at which the inside of a wall begins to press on itself, in that of the outside."""
FOLDED = wp.constant(1.5)
"""Depth at which walls of one neck, which are not kept apart, no longer press on each other, in the distance
at which they begin to. With a tenth of that distance they end 1.5 mm inside each other; at full force down to
that depth ears and wings move twice as far after the let-go.
"""


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
    host: int
    """Balloon in which its own lies; -1 for none."""
    nested: int
    """1 where its balloon lies in another, or another in it."""
    outward: wp.vec3
    """Unstressed outward direction; 0 where the inside of the wall never meets itself."""
    across: float
    """Unstressed distance along its bubble within which the inside of the wall may meet itself, m."""
    position: wp.vec3
    """m"""
    velocity: wp.vec3
    """m/s"""
    speed: float
    """Least speed at which it and other walls are taken to come nearer, m/s."""
    normal: wp.vec3
    """Its outward unit normal."""
    depth: float
    """Deepest overlap taken for a contact on its side, m."""
    apart_depth: float
    """The same where walls are kept apart, m."""
    staying: float
    """Nearness that what it touched before gains, m."""
    neck: int
    """Joint in whose neck it lies; -1 for none."""
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
    seeker.neck = mesh.vertex_neck[i]
    seeker.place = mesh.vertex_place[i]
    seeker.apart = touch.apart * balloons.balloon_radius[seeker.balloon]
    seeker.host = balloons.balloon_host[seeker.balloon]
    seeker.nested = balloons.balloon_nested[seeker.balloon]
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
def in_wall(q: int, seeker: Seeker, mesh: Mesh):
    """Return whether a quad is of the balloon in which a vertex lies, which touches it from inside."""
    return seeker.nested == 1 and int_at(mesh.quad_balloon, q) == seeker.host


@wp.func
def round_wall(q: int, seeker: Seeker, mesh: Mesh):
    """Return whether a quad is of a balloon that lies in that of a vertex."""
    return seeker.nested == 1 and int_at(mesh.quad_host, q) == seeker.balloon


@wp.func
def may_meet(q: int, seeker: Seeker, mesh: Mesh):
    """Return whether a quad may ever touch a vertex."""
    if int_at(mesh.quad_balloon, q) != seeker.balloon:
        # What lies in a balloon meets that, and what lies there beside it.
        return (
            int_at(mesh.quad_host, q) == seeker.host
            or in_wall(q, seeker, mesh)
            or round_wall(q, seeker, mesh)
        )
    return (
        (seeker.bubble >= 0 and int_at(mesh.quad_segment, q) != seeker.bubble)
        or wp.max(wp.abs(vec3_at(mesh.quad_place, q) - seeker.place)) > seeker.apart
        or opposite(q, seeker, mesh)
    )
