"""A crowd for every solver: seven closed tubes side by side, whose ends are turned against each other until
they lie as the strands of a rope.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.capsule_mesh import capsule_mesh
from balloon_usd.balloon.ringed_faces import inner_vertices
from balloon_usd.bench.held import Held
from balloon_usd.bench.pinch_task import LENGTH, RADIUS, Floats, Ints
from balloon_usd.bench.pinch_wall import rest_points
from balloon_usd.bench.walls import Walls

if TYPE_CHECKING:
    from balloon_usd.balloon.tube_mesh import BalloonMesh

TUBES = 7
"""One in the middle, six around it."""
APART = 1.04
"""Distance between the axes of neighbours, in diameters."""
FRAMES = 72
TURNING_FRAMES = 60
"""Frames in which the ends are turned; in the others the hands keep still."""
TURN = math.pi
"""Angle by which the ends are turned against each other, radians."""


@dataclass(frozen=True)
class CrowdTask:
    """The tubes and what hands do to them."""

    around: int = 16
    """Vertices round each tube."""
    frames: int = FRAMES

    @cached_property
    def tube(self) -> BalloonMesh:
        """One tube, along the x axis."""
        return capsule_mesh(LENGTH, RADIUS, self.around, (LENGTH,))

    @cached_property
    def axes(self) -> Floats:
        """Where the axis of every tube lies, (T, 3), m."""
        angles = np.arange(TUBES - 1) * (2.0 * math.pi / (TUBES - 1))
        ring = 2.0 * RADIUS * APART * np.column_stack([0.0 * angles, np.cos(angles), np.sin(angles)])
        return np.concatenate([np.zeros((1, 3)), ring])

    @cached_property
    def points(self) -> Floats:
        """All vertices at the start, tube by tube, (V, 3), m."""
        return self._each(self.tube.points.astype(np.float64))

    @cached_property
    def rest(self) -> Floats:
        """All vertices unstressed, (V, 3), m."""
        return self._each(rest_points(self.tube))

    @cached_property
    def quads(self) -> Ints:
        """All faces, tube by tube, (Q, 4)."""
        count = len(self.tube.points)
        return np.concatenate([self.tube.quads.astype(np.int64) + k * count for k in range(TUBES)])

    @cached_property
    def triangles(self) -> Ints:
        """The faces cut in two, tube by tube, (T, 3)."""
        both = np.stack([self.quads[:, [0, 1, 2]], self.quads[:, [0, 2, 3]]], axis=1)
        return both.reshape(-1, 3)

    @cached_property
    def chambers(self) -> Ints:
        """The triangles of every tube, (tubes, T, 3)."""
        return self.triangles.reshape(TUBES, -1, 3)

    @cached_property
    def ends(self) -> tuple[Ints, Ints]:
        """Vertices of the caps at both ends of all tubes, that hands hold."""
        count, cap = len(self.tube.points), np.arange(inner_vertices(self.around) + self.around)
        tubes = count * np.arange(TUBES)[:, None]
        return (tubes + cap).ravel(), (tubes + count - 1 - cap).ravel()

    def turn_at(self, frame: float) -> float:
        """Angle between the ends at a time in frames, radians; 0 is before the first."""
        return TURN * min(frame / TURNING_FRAMES, 1.0)

    def _each(self, points: Floats) -> Floats:
        """Put points of one tube, (V, 3), at every place."""
        return np.asarray((points[None] + self.axes[:, None]).reshape(-1, 3))


class CrowdHeld(Held):
    """The caps of all tubes, turned about the axis of the tube in the middle."""

    def __init__(self, task: CrowdTask) -> None:
        first, last = task.ends
        super().__init__(np.concatenate([first, last]), task.points)
        self._task = task
        self._side = np.repeat([-0.5, 0.5], [len(first), len(last)])

    def at(self, frame: float) -> tuple[Floats, Floats]:
        """Return how far every one is turned."""
        return np.ones(len(self._side)), self._side * self._task.turn_at(frame)


def walls_of_crowd(task: CrowdTask) -> Walls:
    """Return the walls of the tubes."""
    return Walls(task.points, task.rest, task.quads, task.chambers, CrowdHeld(task), task.frames)


@dataclass(frozen=True)
class CrowdRun:
    """What a solver made of the crowd."""

    shapes: tuple[Floats, ...]
    """Vertices after every frame, (V, 3), m."""
    substeps: int
    """Steps of the solver in one frame."""
    wall_ms: float
    """Time for one frame, the median over all, ms."""
    cpu_ms: float
    """Processor time for one frame, of all cores, the median, ms."""
