"""Particles on the device, for the kernels."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import warp as wp

from balloon_usd.preview.device import vectors
from balloon_usd.preview.kernels.balls import Balls

if TYPE_CHECKING:
    from balloon_usd.preview.particles import Particles


def ball_tree(particles: Particles) -> wp.Bvh | None:
    """Return a tree of the balls' boxes on the current device, None without balls."""
    if not len(particles.radii):
        return None
    low, high = np.split(particles.bounds, 2)
    return wp.Bvh(vectors(low), vectors(high))


def balls_of(particles: Particles, tree: wp.Bvh | None) -> Balls:
    """Return the balls on the current device; their tree must outlive every launch that gets them."""
    balls = Balls()
    balls.tree = wp.uint64(tree.id if tree else 0)
    balls.count = len(particles.radii)
    balls.centres = vectors(particles.centres)
    balls.radii = wp.array(particles.radii, dtype=wp.float32)
    balls.colors = vectors(particles.colors)
    return balls
