"""The wall of the task's tube: as rubber, and as a net of springs for solvers without rubber; and what hands
hold of it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.tube_theory import closed_tube_state
from balloon_usd.bench.held import Held
from balloon_usd.bench.pinch_task import GAUGE, RADIUS
from balloon_usd.bench.walls import Walls

if TYPE_CHECKING:
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.balloon.tube_theory import TubeState
    from balloon_usd.bench.pinch_task import Floats, Ints, PinchTask

HOOP_STRETCH = 1.1
"""Stretch of the wall round the tube at the start; rubber of 0.4 mm holds the pressure then."""
SPRING = GAUGE * RADIUS / (3.0 * (HOOP_STRETCH - 1.0))
"""Stiffness of a spring, N/m: three of them, a side and two diagonals, carry the hoop tension p R."""
SEALED = ATMOSPHERE + GAUGE
"""Pressure of the gas at the start, Pa."""


def blown_up() -> TubeState:
    """Return the state of the rubber at the start."""
    return closed_tube_state(rubber_named(), HOOP_STRETCH)


def rest_points(mesh: BalloonMesh) -> Floats:
    """Return the unstressed vertices of a tube along the x axis, (V, 3), m."""
    state = blown_up()
    return np.asarray(mesh.points.astype(np.float64) / np.array([state.b, state.a, state.a]))


def wall_thickness() -> float:
    """Return the unstressed thickness of rubber that holds the pressure at that stretch, m."""
    state = blown_up()
    return GAUGE * RADIUS / (state.a * state.p_star)


def springs(faces: Ints) -> Ints:
    """Return the ends of all springs: sides and both diagonals of the faces (Q, 4), (S, 2)."""
    pairs = faces.astype(np.int64)[:, [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]]].reshape(-1, 2)
    return np.unique(np.sort(pairs, axis=1), axis=0)


def walls_of_pinch(task: PinchTask) -> Walls:
    """Return the walls of the task of pinch and turn."""
    start, held = task.mesh.points.astype(np.float64), HeldVertices(task)
    quads, rest = task.mesh.quads.astype(np.int64), rest_points(task.mesh)
    return Walls(start, rest, quads, task.triangles[None], held, task.frames)


class HeldVertices(Held):
    """Vertices that hands hold: the caps, and the rings between the fingers.

    These stay at their places along the tube and share out the turn among them: solvers without hands know no
    ring that is thin and yet free to slide and to turn.
    """

    def __init__(self, task: PinchTask) -> None:
        first, last = task.ends
        rings = [task.ring(k) for k in task.pinched]
        shares = np.linspace(-0.5, 0.5, len(rings) + 2)[1:-1]
        super().__init__(np.concatenate([first, last, *rings]), task.mesh.points.astype(np.float64))
        self.task = task
        ends = np.repeat([-0.5, 0.5], [len(first), len(last)])
        self._side = np.concatenate([ends, np.repeat(shares, task.mesh.around)])
        self._pinched = np.arange(len(self.index)) >= len(ends)

    def at(self, frame: float) -> tuple[Floats, Floats]:
        """Return how far every one is pinched and turned."""
        pinch = np.where(self._pinched, self.task.pinch_at(frame - 1.0), 1.0)
        return pinch, self._side * self.task.turn_at(frame - 1.0)
