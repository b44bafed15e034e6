"""Hinges: rigid parts of a figure that spring against each other about its joints, free in the air."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from itertools import product
from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.air import AIR_DENSITY
from balloon_usd.solver.latex.spins import VertexSet
from balloon_usd.solver.rotations import NO_ANGLE, cross, rotation, rotation_vector

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.solver.latex.controls import LatexControls
    from balloon_usd.solver.latex.scene import LatexScene

Floats = NDArray[np.float64]

DIRECTIONS = np.array([way for way in product((-1.0, 0.0, 1.0), repeat=3) if any(way)])
"""In which the vertices of a part are looked for that may be the fastest, (26, 3): others are faster by 8 %
at most.
"""


@dataclass
class Part:
    """A rigid body between hinges."""

    mass: float
    """kg."""
    centre: Floats
    """Of its mass, before it moved, (3,), m."""
    inertia: Floats
    """Moment of inertia about its centre, before it turned, (3, 3), kg m2."""
    arms: Floats
    """The outermost of its vertices from its centre, before it turned, (E, 3), m."""
    turned: Floats = field(default_factory=lambda: np.eye(3))
    """How it has turned so far, (3, 3)."""

    @classmethod
    def of(cls, places: Floats, mass: Floats) -> Self:
        """Return a part of some vertices, (V, 3), m, with their masses (V,), kg."""
        centre = mass @ places / mass.sum()
        arms = places - centre
        weighted = mass[:, None] * arms
        inertia = float((weighted * arms).sum()) * np.eye(3) - weighted.T @ arms
        outermost = np.unique((arms @ DIRECTIONS.T).argmax(axis=0))
        return cls(float(mass.sum()), centre, inertia, arms[outermost])

    def arm(self, place: Floats) -> Floats:
        """Return what points from its centre to a place of it, given as it was before it turned, (3,), m."""
        return np.asarray(self.turned @ (place - self.centre))


class Hinge(NamedTuple):
    """Where two parts meet, by their numbers; all places as before anything moved, (3,), m."""

    before: int
    beyond: int
    joint: Floats
    bubble_before: Floats
    """Middle of the bubble beside the joint."""
    bubble_beyond: Floats


class Response(NamedTuple):
    """How parts answer to torques in their hinges."""

    compliance: Floats
    """Rate of every hinge for an impulse of torque in each, (H, H), 1/(kg m2)."""
    turns: Floats
    """Angular velocity of every part for the same, (P, 3, H), 1/(kg m2)."""
    shifts: Floats
    """Velocity of the centre of every part for the same, (P, 3, H), m/(kg m2)."""


class Limits(NamedTuple):
    """How fast parts may move."""

    wall: float
    """m/s."""
    centre: float
    """Of the mass of a part, m/s."""
    turn: float
    """rad/s."""


class HingedParts:
    """Parts that hang together in a tree of hinges, at a moment, and how they have moved since.

    A wound neck is a ball joint with a pair of equal and opposite torques along the line between its two
    bubbles, so that the momentum and the angular momentum of all stay zero.
    """

    def __init__(self, parts: Sequence[Part], hinges: Sequence[Hinge]) -> None:
        """Begin where they are; the hinges join all parts, without a closed way."""
        self.parts = parts
        self.hinges = hinges
        self._mass = np.array([part.mass for part in parts])
        self._way = _from_first(hinges)

    def centres(self) -> Floats:
        """Return where the centres of the parts are now, (P, 3), m."""
        found = np.array([part.centre for part in self.parts])
        middle = self._mass @ found / self._mass.sum()
        for near, far, joint in self._way:
            found[far] = found[near] + self.parts[near].arm(joint) - self.parts[far].arm(joint)
        return np.asarray(found + middle - self._mass @ found / self._mass.sum())

    def response(self) -> Response:
        """Return how the parts, turned as they are, answer to torques in their hinges."""
        count = len(self.parts)
        way = np.zeros((count, 3, 3 * count))
        for near, far, joint in self._way:
            way[far] = way[near]
            way[far, :, 3 * near : 3 * near + 3] -= cross(self.parts[near].arm(joint))
            way[far, :, 3 * far : 3 * far + 3] += cross(self.parts[far].arm(joint))
        way -= np.tensordot(self._mass / self._mass.sum(), way, axes=1)
        laws = np.tensordot(self._mass[:, None, None] * way, way, axes=([0, 1], [0, 1]))
        for number, part in enumerate(self.parts):
            own = slice(3 * number, 3 * number + 3)
            laws[own, own] += part.turned @ part.inertia @ part.turned.T
        torques = self._torques()
        found = np.asarray(np.linalg.solve(laws, torques), dtype=np.float64)
        turns = np.asarray(found.reshape(count, 3, -1))
        return Response(torques.T @ found, turns, np.asarray(way @ found))

    def _torques(self) -> Floats:
        """Return the torques on all parts of a pair of 1 N m in every hinge, (3 P, H), N m."""
        found, centres = np.zeros((3 * len(self.parts), len(self.hinges))), self.centres()
        for number, hinge in enumerate(self.hinges):
            a, b = hinge.before, hinge.beyond
            axis = centres[b] + self.parts[b].arm(hinge.bubble_beyond)
            axis -= centres[a] + self.parts[a].arm(hinge.bubble_before)
            axis /= max(float(np.linalg.norm(axis)), 1e-12)
            found[3 * a : 3 * a + 3, number], found[3 * b : 3 * b + 3, number] = -axis, axis
        return found

    def turn(self, rates: Floats, seconds: float) -> None:
        """Turn the parts for a while at their angular velocities, (P, 3), rad/s."""
        for part, rate in zip(self.parts, rates, strict=True):
            part.turned = rotation(rate * seconds) @ part.turned

    def share_below(self, response: Response, impulses: Floats, limits: Limits) -> float:
        """Return the share of impulses in all hinges, (H,), N m s, with which nothing is too fast."""
        turns, shifts = response.turns @ impulses, response.shifts @ impulses
        walls = (
            shift @ part.turned + np.cross(turn @ part.turned, part.arms)
            for part, turn, shift in zip(self.parts, turns, shifts, strict=True)
        )
        wall = max(float(np.linalg.norm(each, axis=1).max()) for each in walls)
        centre, turn = (float(np.linalg.norm(each, axis=1).max()) for each in (shifts, turns))
        return 1.0 / max(1.0, wall / limits.wall, centre / limits.centre, turn / limits.turn)

    def fastest_walls(self, response: Response) -> Floats:
        """Return the speed of the fastest vertex for an impulse in each hinge, (H,), m/(s N m s)."""
        found = np.zeros(len(self.hinges))
        for part, turns, shifts in zip(self.parts, response.turns, response.shifts, strict=True):
            arms = part.arms @ part.turned.T
            walls = shifts[:, :, None] + np.cross(turns[:, :, None], arms.T[:, None, :], axis=0)
            found = np.maximum(found, np.linalg.norm(walls, axis=0).max(axis=1))
        return found


def _from_first(hinges: Sequence[Hinge]) -> list[tuple[int, int, Floats]]:
    """Return all hinges such that each joins a part to one that is reached, beginning with the first: the
    number of that, of the new one, and the joint.
    """
    way: list[tuple[int, int, Floats]] = []
    reached, left = {0}, list(hinges)
    while left:
        hinge = next(h for h in left if h.before in reached or h.beyond in reached)
        near, far = (hinge.before, hinge.beyond) if hinge.before in reached else (hinge.beyond, hinge.before)
        way.append((near, far, hinge.joint))
        reached.add(far)
        left = [other for other in left if other is not hinge]
    return way


class HingedFigure:
    """The vertices of a figure, and on which side of each of its hinges they lie."""

    def __init__(
        self,
        scene: LatexScene,
        vertices: NDArray[np.int64],
        beyond: NDArray[np.bool_],
        joints: Sequence[int],
        segments: NDArray[np.int32],
    ) -> None:
        """Part some vertices.

        Args:
            scene: where they are.
            vertices: of the scene, (V,).
            beyond: whether every one of them turns with what lies beyond each hinge, (H, V).
            joints: of the hinges, in the scene.
            segments: before and beyond each hinge, (H, 2).
        """
        self._joints, self._segments = joints, segments
        self._vertices, self._beyond = vertices, beyond
        mass = scene.mass.numpy()[self._vertices].astype(float)
        self._segment = scene.vertex_segment.numpy()[self._vertices]
        inside = np.unique(self._segment[self._segment >= 0])
        gas = AIR_DENSITY * float(scene.volume.numpy()[inside].sum())
        rubber = float(scene.true_mass.numpy()[self._vertices].sum())
        self._true_mass = mass * ((rubber + gas) / float(mass.sum()))
        """Mass of every vertex, (V,), kg: as in the solver, but all weighs as much as rubber and gas."""
        self._moving: tuple[int, ...] = ()
        """Hinges about which parts turned last."""
        self._part = np.zeros(0, dtype=np.int64)
        """Part of every vertex there, (V,)."""
        self._sets: list[VertexSet] = []
        """Vertices of the scene in every part."""

    def parts(
        self, x: NDArray[np.float32], middle: NDArray[np.float32], moving: Sequence[int]
    ) -> HingedParts:
        """Return the parts between some of its hinges as they are.

        `x`: all vertices, (V, 3), m; `middle`: of all joints, (J, 3), m.
        """
        self._divide(tuple(moving))
        places = x[self._vertices].astype(float)
        parts = [
            Part.of(places[chosen], self._true_mass[chosen])
            for chosen in (self._part == number for number in range(len(self._sets)))
        ]
        return HingedParts(parts, [self._hinge(hinge, places, middle) for hinge in moving])

    def _divide(self, moving: tuple[int, ...]) -> None:
        """Take note of the parts between some hinges; they stay the same objects while these do."""
        if moving == self._moving:
            return
        self._moving = moving
        sides = self._beyond[list(moving)]
        _, self._part = np.unique(sides, axis=1, return_inverse=True)
        self._part = self._part.reshape(-1)
        count = int(self._part.max()) + 1
        self._sets = [VertexSet.of(self._vertices[self._part == number]) for number in range(count)]

    def _hinge(self, hinge: int, places: Floats, middle: NDArray[np.float32]) -> Hinge:
        """Return a hinge between two parts, as it is."""
        chosen = [np.flatnonzero(self._segment == segment) for segment in self._segments[hinge]]
        before, beyond = (int(np.bincount(self._part[own]).argmax()) for own in chosen)
        bubbles = (places[own].mean(axis=0) for own in chosen)
        return Hinge(before, beyond, middle[self._joints[hinge]].astype(float), *bubbles)

    def follow(self, hands: LatexControls, moved: HingedParts, seconds: float) -> None:
        """Let all vertices follow the motion of their parts in the coming frame of so many seconds."""
        for vertices, part, centre in zip(self._sets, moved.parts, moved.centres(), strict=True):
            rate, axis, drift = screw(part.turned, centre - part.centre, seconds)
            spin = {"point": part.centre, "axis": axis, "rate": rate, "drift": drift, "free": 1}
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
