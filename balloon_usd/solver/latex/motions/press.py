"""Pressing a finger with a round tip, or a palm, into a wall of latex, and taking it back."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.kernels.physics.fingertip import DEEPEST, PALM_RADIUS
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.press import press_profile

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.operations import moves
    from balloon_usd.plan.strip import PlannedBubble
    from balloon_usd.solver.latex.sculpture import LatexSculpture

TIP_RADIUS = 0.012
"""Radius of a fingertip, m: a thumb is 24 mm wide, and the faces of a tube in `draft` are 12."""
TIP_STIFFNESS = 0.3
"""Stiffness of a wall that is inside a finger, in vertex masses per squared time step."""
YIELDING = 600.0
"""Stiffness of a blown up wall under a fingertip, N/m, by which a finger that presses with a force corrects
how deep it is: of a 260 it is 280 to 500 N/m.
"""
FASTEST = 0.004
"""Farthest that such a finger goes in a frame, m."""


class LatexPress(Motion):
    """A finger or a palm on a bubble, while the other hand is on its far side, and holds some rings."""

    def __init__(self, move: moves.Press, sculpture: LatexSculpture) -> None:
        """Take hold of the rings, and find the place under the finger."""
        self._hands, self._move, self._sculpture = sculpture.hands, move, sculpture
        self._body = sculpture.body[move.balloon]
        self._hands.touch(sculpture.bodies)
        for ring in move.holds:
            self._hands.clasp(sculpture.joints[ring], sculpture.frame.middle)
        self._along = np.array(move.point)
        self._wall = _PressedWall(move, sculpture)
        self._touch, self._palm = self._wall.sides(self._hands.places, self._along)
        self._depth = 0.0

    def advance(self, share: float) -> None:
        """Press as far, or as hard, as the time tells, or take the finger back."""
        before, pressed = self._depth, press_profile(share)
        if self._move.force > 0.0:
            tip = self._touch + before * self._along
            missing = self._move.force * pressed - self._wall.force(self._hands.places, tip, self._along)
            self._depth += float(np.clip(missing / YIELDING, -FASTEST, FASTEST))
        else:
            # Of two palms each goes half of the way.
            self._depth = self._move.depth * pressed * (0.5 if self._move.flat else 1.0)
        begin, end, _ = self._sculpture.frame
        self._hands.set_fingertip(
            self._body,
            start=self._touch + before * self._along,
            end=self._touch + self._depth * self._along,
            velocity=(self._depth - before) / (end - begin) * self._along,
            along=self._along,
            stiff=TIP_STIFFNESS,
            radius=self._wall.reach,
            flat=int(self._move.flat),
            palm=self._palm - before * self._along if self._move.flat else self._palm,
            segment=self._wall.segment,
        )


def _away(along: float, bubble: PlannedBubble, at: float) -> float:
    """Return how far a ring is from a place of a bubble along its flat balloon, m; rings of others are
    farthest.
    """
    return abs(along - at) if bubble.rest_start < along < bubble.rest_end else math.inf


class _PressedWall:
    """The wall of a bubble under a finger."""

    def __init__(self, move: moves.Press, sculpture: LatexSculpture) -> None:
        scene = sculpture.scene
        body = sculpture.body[move.balloon]
        mesh, start = scene.bodies[body], int(scene.vertex_start[body])
        self.reach = PALM_RADIUS if move.flat else TIP_RADIUS
        """Radius of what presses, m."""
        segments = scene.vertex_segment.numpy()
        bubble = sculpture.plan.strips[move.balloon].bubble_at(move.along)
        first, around = min(
            # Rings of joints are of no bubble.
            (ring for ring in mesh.mesh_rings if segments[start + ring[0]] >= 0),
            key=lambda ring: _away(float(mesh.along[ring[0]]), bubble, move.along),
        )
        self._ring = slice(start + first, start + first + around)
        self.segment = int(segments[start + first])
        """Number of the segment in the scene."""
        self._vertices = np.flatnonzero(segments == self.segment)
        """Its vertices in the scene."""
        quads = start + mesh.quads
        self._quads = quads[np.isin(quads, self._vertices).all(axis=1)]
        each = TIP_STIFFNESS * scene.mass.numpy() / scene.settings.dt**2
        self._stiffness = np.concatenate([each[self._vertices], each[self._quads].mean(axis=1)])
        """Force on every vertex, and on the middle of every quad, by how far it is inside, N/m."""

    def sides(
        self, places: NDArray[np.float32], along: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return where a finger that comes along a unit direction touches it, and its far side, (3,), m.

        `places`: of all vertices of the scene, (V, 3), m.
        """
        middle = places[self._ring].mean(axis=0, dtype=np.float64)
        arm = places[self._vertices] - middle
        ahead = arm @ along
        aside = np.linalg.norm(arm - ahead[:, None] * along, axis=1)
        under = ahead[aside < max(self.reach, 1.5 * float(aside.min()))]
        return middle + float(under.min()) * along, middle + float(under.max()) * along

    def force(
        self, places: NDArray[np.float32], tip: NDArray[np.float64], along: NDArray[np.float64]
    ) -> float:
        """Return the force (N) with which it presses on a finger whose foremost point is `tip`, (3,), m."""
        arm = np.concatenate([places[self._vertices], places[self._quads].mean(axis=1)]) - tip
        ahead = arm @ along
        aside = np.linalg.norm(arm - ahead[:, None] * along, axis=1)
        under = (aside < TIP_RADIUS) & (ahead > -2.0 * TIP_RADIUS)
        rise = np.sqrt(1.0 - (aside[under] / TIP_RADIUS) ** 2)
        depth = np.clip(rise * (TIP_RADIUS * (rise - 1.0) - ahead[under]), 0.0, DEEPEST)
        return float(self._stiffness[under] @ depth)
