"""One task for every solver: a closed tube is pinched in its middle, then its ends are turned one whole turn
against each other.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.capsule_mesh import EXPERIMENT_LENGTH, EXPERIMENT_RADIUS, capsule_mesh

if TYPE_CHECKING:
    from balloon_usd.balloon.tube_mesh import BalloonMesh

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

LENGTH = EXPERIMENT_LENGTH
"""Length of the tube, m: that of the experiment (Kosaka 2008, chapter 4)."""
RADIUS = EXPERIMENT_RADIUS
"""Radius of the tube, m: a 260 blown up, two inches wide."""
GAUGE = 2500.0
"""Gauge pressure at the start, Pa."""
FPS = 60.0
FRAMES = 60
PINCHED = 0.15
"""Radius of the pinched middle, in its radius at the start."""
TURN = 2.0 * math.pi
"""Angle by which the ends are turned against each other, radians."""
FINGERS = 0.026
"""Width of a pinch, m: finger and thumb gather so much of the tube's length into the neck."""
AROUND = {1602: 32, 6402: 64, 25602: 128}
"""Vertices round the tube, by the vertices of the mesh."""


@dataclass(frozen=True)
class PinchTask:
    """The tube and what hands do to it."""

    vertices: int
    """Vertices of the mesh, one of `AROUND`."""
    width: float = FINGERS
    """Width of the pinch, m: 0 for one ring."""
    frames: int = FRAMES
    """Half of them for the pinch, half for the turn."""

    @cached_property
    def mesh(self) -> BalloonMesh:
        """The tube at the start, along x."""
        return capsule_mesh(LENGTH, RADIUS, AROUND[self.vertices], (LENGTH,))

    @property
    def middle(self) -> int:
        """Ring in the middle."""
        return len(self.mesh.ring_start) // 2

    @cached_property
    def pinched(self) -> tuple[int, ...]:
        """Rings that the pinch draws in, in order; their number is odd."""
        away = np.abs(self.mesh.ring_along - self.mesh.ring_along[self.middle])
        return tuple(int(k) for k in np.flatnonzero(away <= 0.5 * self.width))

    @cached_property
    def triangles(self) -> Ints:
        """The faces cut in two, (T, 3)."""
        quads = self.mesh.quads.astype(np.int64)
        return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])

    @cached_property
    def ends(self) -> tuple[Ints, Ints]:
        """Vertices of the two caps with their borders, that hands hold."""
        x, edge = self.mesh.points[:, 0], float(self.mesh.ring_along[0])
        # Half a millimetre lies far within a row of faces.
        clear = 5.0e-4
        return np.flatnonzero(x < edge + clear), np.flatnonzero(x > LENGTH - edge - clear)

    def ring(self, index: int) -> Ints:
        """Vertices of a ring, in order."""
        return int(self.mesh.ring_start[index]) + np.arange(self.mesh.around)

    def pinch_at(self, frame: float) -> float:
        """Radius of the middle at the end of a frame, in its radius at the start."""
        return 1.0 - (1.0 - PINCHED) * min(max(2.0 * (frame + 1) / self.frames, 0.0), 1.0)

    def turn_at(self, frame: float) -> float:
        """Angle between the ends at the end of a frame, radians."""
        return TURN * max(2.0 * (frame + 1) / self.frames - 1.0, 0.0)


@dataclass(frozen=True)
class PinchRun:
    """What a solver made of the task."""

    start: Floats
    """Vertices before the pinch, (V, 3), m."""
    end: Floats
    """Vertices after the turn, (V, 3), m."""
    substeps: int
    """Steps of the solver in one frame."""
    wall_ms: float
    """Time for one frame, the median over all, ms."""
    cpu_ms: float
    """Processor time for one frame, of all cores, the median, ms."""
