"""A hinge: two parts of a sculpture that spring against each other about a joint, free in the air."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.air import AIR_DENSITY
from balloon_usd.solver.latex.spins import VertexSet
from balloon_usd.solver.rotations import NO_ANGLE, cross, rotation, rotation_vector

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.solver.latex.controls import LatexControls
    from balloon_usd.solver.latex.scene import LatexScene

Floats = NDArray[np.float64]

CLEAR = 1e-6
"""What lies farther than this beyond a joint turns with what lies beyond it, m."""


@dataclass
class Part:
    """One side of a hinge as a rigid body; its moments are about the joint."""

    mass: float
    """kg."""
    first: Floats
    """First moment, (3,), kg m."""
    inertia: Floats
    """Moment of inertia, (3, 3), kg m2."""
    bubble: Floats
    """From the joint to the middle of the bubble beside it, (3,), m."""
    turned: Floats = field(default_factory=lambda: np.eye(3))
    """How it has turned so far, (3, 3)."""

    @classmethod
    def of(cls, arm: Floats, mass: Floats, bubble: Floats) -> Part:
        """Return a part of some vertices, given as arms (V, 3), m, with their masses (V,), kg."""
        weighted = mass[:, None] * arm
        inertia = float((weighted * arm).sum()) * np.eye(3) - weighted.T @ arm
        return cls(float(mass.sum()), weighted.sum(axis=0), inertia, bubble)

    def turn(self, by: Floats) -> None:
        """Turn it by a rotation vector, (3,), rad."""
        r = rotation(by)
        self.first, self.bubble = r @ self.first, r @ self.bubble
        self.inertia, self.turned = r @ self.inertia @ r.T, r @ self.turned


@dataclass
class HingedParts:
    """Both sides of a hinge at a moment, and how they have moved since."""

    point: Floats
    """Where the joint was, (3,), m."""
    before: Part
    beyond: Part
    moved: Floats = field(default_factory=lambda: np.zeros(3))
    """How far the joint has moved, (3,), m."""

    def response(self) -> tuple[float, Floats]:
        """Return the inertia of both parts against each other (kg m2), and how they move while one turns by
        a radian against the other: the joint (m), what lies before and what lies beyond (rad), (9,).

        The wound neck is a ball joint with a pair of equal and opposite torques along the line between the
        two bubbles, so that the momentum and the angular momentum of all stay zero.
        """
        a, b = self.before, self.beyond
        axis = b.bubble - a.bubble
        axis /= max(float(np.linalg.norm(axis)), 1e-12)
        away, there = cross(a.first), cross(b.first)
        laws = np.zeros((9, 9))
        laws[:3] = np.hstack([(a.mass + b.mass) * np.eye(3), -away, -there])
        laws[3:6, :6] = np.hstack([away, a.inertia])
        laws[6:, :3], laws[6:, 6:] = there, b.inertia
        found = np.linalg.solve(laws, np.concatenate([np.zeros(3), -axis, axis]))
        rate = float(axis @ (found[6:] - found[3:6]))
        return 1.0 / rate, found / rate

    def move(self, motion: Floats, angle: float) -> None:
        """Turn both parts against each other by an angle (rad), with the motion that `response` gives."""
        self.moved = self.moved + angle * motion[:3]
        self.before.turn(angle * motion[3:6])
        self.beyond.turn(angle * motion[6:])


class Hinge:
    """A joint of one balloon, and what lies on both of its sides."""

    def __init__(self, scene: LatexScene, beyond: Mapping[int, float], segments: tuple[int, int]) -> None:
        """Part some bodies.

        Args:
            scene: where they are.
            beyond: place along every body, unstressed distance from the knot, beyond which it turns with what
                lies beyond (m); infinite where all of it lies on one side.
            segments: before and beyond the joint.
        """
        self._vertices = np.r_[tuple(map(scene.vertices_of, beyond))]
        self._mass = scene.mass.numpy()[self._vertices].astype(float)
        self._beyond = np.concatenate([scene.bodies[b].along > at + CLEAR for b, at in beyond.items()])
        self._sides = [VertexSet.of(self._vertices[side]) for side in (~self._beyond, self._beyond)]
        """What lies before the joint, and what lies beyond."""
        of = scene.vertex_segment.numpy()[self._vertices]
        gas = AIR_DENSITY * float(scene.volume.numpy()[np.unique(of[of >= 0])].sum())
        rubber = float(scene.true_mass.numpy()[self._vertices].sum())
        self.lightness = (rubber + gas) / float(self._mass.sum())
        """Mass of its rubber and gas, in that which its rubber has in the solver."""
        self._bubbles = [np.flatnonzero(of == segment) for segment in segments]

    def parts(self, x: NDArray[np.float32], point: NDArray[np.float32]) -> HingedParts:
        """Return both parts as they are; `x`: all vertices, (V, 3), m; `point`: the joint, (3,), m."""
        arm = x[self._vertices].astype(float) - point
        before, beyond = (
            Part.of(arm[side], self._mass[side], arm[bubble].mean(axis=0))
            for side, bubble in zip((~self._beyond, self._beyond), self._bubbles, strict=True)
        )
        return HingedParts(point.astype(float), before, beyond)

    def reach(self, x: NDArray[np.float32], point: NDArray[np.float32], motion: Floats) -> float:
        """Return how far the vertex that moves most goes while both parts turn against each other, m/rad.

        `x`, `point`: as of `parts`; `motion`: of `HingedParts.response`.
        """
        arm = x[self._vertices].astype(float) - point
        turn = np.where(self._beyond[:, None], motion[6:], motion[3:6])
        return float(np.linalg.norm(motion[:3] + np.cross(turn, arm), axis=1).max())

    def follow(self, hands: LatexControls, parts: HingedParts, seconds: float) -> None:
        """Let all vertices follow the motion of both parts in the coming frame of so many seconds."""
        for vertices, part in zip(self._sides, (parts.before, parts.beyond), strict=True):
            rate, axis, drift = screw(part.turned, parts.moved, seconds)
            spin = {"point": parts.point, "axis": axis, "rate": rate, "drift": drift, "free": 1}
            hands.spins.turn(vertices, spin)


def screw(turned: Floats, moved: Floats, seconds: float) -> tuple[float, Floats, Floats]:
    """Return the angular velocity (rad/s), its axis and the velocity (m/s) that, kept for some seconds, turn
    and move a body so (the logarithm of a rigid motion; Murray, Li and Sastry 1994, 2.3).
    """
    vector = rotation_vector(turned)
    angle = float(np.linalg.norm(vector))
    if angle < NO_ANGLE:
        return 0.0, np.array([1.0, 0.0, 0.0]), moved / seconds
    k = cross(vector / angle)
    mean = np.eye(3) + (1.0 - math.cos(angle)) / angle * k + (1.0 - math.sin(angle) / angle) * k @ k
    return angle / seconds, vector / angle, np.asarray(np.linalg.solve(mean, moved)) / seconds
