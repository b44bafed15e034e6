"""Pressing a finger into a wall, and taking it back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.smooth import smooth

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.operations import moves
    from balloon_usd.solver.scene import Scene
    from balloon_usd.solver.sculpture import Sculpture

FINGER_RADIUS = 0.012
"""Distance from the middle of a fingertip at which it no longer touches, m."""
FINGER_STIFFNESS = 0.3
"""Stiffness under the middle of a fingertip, in vertex masses per squared time step."""
PRESSING, RELEASING = 0.35, 0.65
"""Shares of a press's time at which the finger is all the way in, and begins to leave."""


class Press(Motion):
    """A finger on a wall, while the other hand holds some rings."""

    def __init__(self, move: moves.Press, sculpture: Sculpture) -> None:
        """Take hold of the rings, and find the place under the finger."""
        self._hands, self._move = sculpture.hands, move
        self._body = sculpture.body[move.balloon]
        self._hands.touch(sculpture.bodies)
        for ring in move.holds:
            self._hands.grip(sculpture.joints[ring], sculpture.frame.middle)
        self._patch = patch_under(sculpture.scene, self._body, move)
        self._stiffness = FINGER_STIFFNESS / float(self._patch.share.max()) if move.depth > 0.0 else 0.0
        self._along = np.array(move.point)
        self._pressed = 0.0

    def advance(self, share: float) -> None:
        """Press as far as the time tells, or take the finger back."""
        move, touch = self._move, self._patch.touch
        before, self._pressed = self._pressed, press_profile(share)
        self._hands.set_finger(
            self._body,
            self._patch.share,
            start=touch + move.depth * before * self._along,
            end=touch + move.depth * self._pressed * self._along,
            load_start=move.force * before,
            load_end=move.force * self._pressed,
            along=self._along,
            stiff=self._stiffness,
        )


@dataclass(frozen=True)
class Patch:
    """Where a finger touches a wall."""

    touch: NDArray[np.float64]
    """Place of the fingertip when it just touches, (3,), m."""
    share: NDArray[np.float32]
    """Share of the finger's force on every vertex of the balloon, (V,), adding up to 1."""


def press_profile(share: float) -> float:
    """Return how far a finger has pressed, 0 to 1, at a share of a press's time."""
    return smooth(min(1.0, share / PRESSING, max(0.0, (1.0 - share) / (1.0 - RELEASING))))


def patch_under(scene: Scene, body: int, move: moves.Press) -> Patch:
    """Return the patch that a finger meets which comes along its direction onto a place of a balloon.

    The finger reaches at least the nearest vertex, however coarse the mesh is.
    """
    b = scene.bodies[body]
    x = scene.x.numpy()[scene.vertices_of(body)].astype(np.float64)
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
