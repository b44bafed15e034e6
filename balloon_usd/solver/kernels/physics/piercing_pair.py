"""The five vertices of an edge and a triangle that it would pierce."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Crossings
from balloon_usd.solver.kernels.device.array_access import vec3_at

FARTHEST_MOVED = wp.constant(0.1)
"""Farthest that a vertex is taken to have moved since walls were last kept apart, m: sums never overflow."""


@wp.func
def vertex_of_pair(k: int, ends: wp.vec3i, other: wp.vec3i):
    """Return one of the five vertices of an edge and a triangle, the ends of the edge first."""
    return wp.where(k < 2, ends[k % 2], other[wp.max(k - 2, 0)])


@wp.func
def weight_in_pair(k: int, share: float, on_face: wp.vec3):
    """Return how much of where an edge and a triangle touch is such a vertex, below 0 in the triangle."""
    if k < 2:
        return wp.where(k == 0, 1.0 - share, share)
    return -on_face[wp.max(k - 2, 0)]


@wp.func
def moved(i: int, crossings: Crossings):
    """Return how far a vertex goes since walls were last kept apart (m)."""
    way = vec3_at(crossings.x_apart, i) - vec3_at(crossings.x_safe, i)
    return wp.vec3(
        wp.clamp(way[0], -FARTHEST_MOVED, FARTHEST_MOVED),
        wp.clamp(way[1], -FARTHEST_MOVED, FARTHEST_MOVED),
        wp.clamp(way[2], -FARTHEST_MOVED, FARTHEST_MOVED),
    )
