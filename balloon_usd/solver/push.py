"""Pushing: where a finger touches a wall, and how far it presses at what time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.plan.closing import smooth

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.operations.moves import Press
    from balloon_usd.solver.scene import Scene

FINGER_RADIUS = 0.012
"""Distance from the middle of a fingertip at which it no longer touches, m."""
FINGER_STIFFNESS = 0.3
"""Stiffness under the middle of a fingertip, in vertex masses per squared time step."""
PRESSING, RELEASING = 0.35, 0.65
"""Shares of a push's time at which the finger is all the way in, and begins to leave."""


@dataclass(frozen=True)
class Patch:
    """Where a finger touches a wall."""

    touch: NDArray[np.float64]
    """Place of the fingertip when it just touches, (3,), m."""
    share: NDArray[np.float32]
    """Share of the finger's force on every vertex of the balloon, (V,), adding up to 1."""


def press_profile(share: float) -> float:
    """Return how far a finger has pressed, 0 to 1, at a share of a push's time."""
    return smooth(min(1.0, share / PRESSING, max(0.0, (1.0 - share) / (1.0 - RELEASING))))


def patch_under(scene: Scene, body: int, move: Press) -> Patch:
    """Return the patch that a finger meets which comes along its direction onto a place of a balloon.

    The finger reaches at least the nearest vertex, however coarse the mesh is.
    """
    b = scene.bodies[body]
    x = scene.x.numpy()[scene.vertex_start[body] : scene.vertex_start[body + 1]].astype(np.float64)
    rings = np.array([b.along[first] for first, _ in b.mesh_rings])
    first, around = b.mesh_rings[int(np.argmin(np.abs(rings - move.along)))]
    middle = x[first : first + around].mean(axis=0)
    direction = np.array(move.point)
    arm = x - middle
    depth = arm @ direction
    aside = np.linalg.norm(arm - depth[:, None] * direction, axis=1)
    facing = depth < 0.0
    reach = max(FINGER_RADIUS, 1.5 * float(aside[facing].min()))
    share = np.where(facing & (aside < reach), np.cos(0.5 * np.pi * np.minimum(aside / reach, 1.0)) ** 2, 0.0)
    touch = middle + direction * float(depth[share > 0.0].min())
    return Patch(touch, (share / share.sum()).astype(np.float32))
