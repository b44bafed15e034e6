"""A wall of springs with gas inside, and hands on it, for Newton's solvers."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.balloon.rubber import LATEX_DENSITY
from balloon_usd.bench.kernels.sealed_tube import add_volume, hold, press_wall
from balloon_usd.bench.pinch_shape import volume
from balloon_usd.bench.pinch_task import FPS
from balloon_usd.bench.pinch_wall import SEALED, SPRING, springs, wall_thickness

if TYPE_CHECKING:
    from balloon_usd.bench.pinch_task import Floats
    from balloon_usd.bench.walls import Walls

DAMPING = 0.02
"""Damping of a spring, N s/m: calms the gas without slowing the hands."""


class NewtonWall:
    """Closed walls as particles, with gas and hands added."""

    def __init__(self, walls: Walls, model: Any, solver: Any, substeps: int) -> None:
        """Begin with the walls as they are blown up."""
        self._solver, self._held, self._substeps = solver, walls.held, substeps
        self.now, self.next = model.state(), model.state()
        for state in (self.now, self.next):
            state.particle_q.assign(walls.points.astype(np.float32))
        self._chambers: list[Any] = [wp.array(faces.astype(np.int32), dtype=int) for faces in walls.chambers]
        self._volumes: list[Any] = [wp.zeros(1, dtype=float) for _ in walls.chambers]
        self._sealed = [SEALED * volume(walls.points, faces) for faces in walls.chambers]
        held = walls.held.index
        self._index: Any = wp.array(held, dtype=int)
        self._start: Any = wp.array(walls.points[held].astype(np.float32), dtype=wp.vec3)
        self._drawn, self._turn = (wp.zeros(len(held), dtype=wp.vec2) for _ in range(2))

    def points(self) -> Floats:
        """Where all vertices are, (V, 3), m."""
        return np.array(self.now.particle_q.numpy(), dtype=np.float64)

    def advance(self, frame: int) -> None:
        """Do what the task says for a frame."""
        dt = 1.0 / (FPS * self._substeps)
        before, after = self._held.at(frame), self._held.at(frame + 1)
        for way, begin, end in zip((self._drawn, self._turn), before, after, strict=True):
            way.assign(np.column_stack([begin, end]).astype(np.float32))
        hands = [self._index, self._start, self._drawn, self._turn]
        for k in range(self._substeps):
            held = [(k + 1) / self._substeps, self.now.particle_q, self.now.particle_qd]
            wp.launch(hold, len(self._held.index), inputs=[*hands, *held])
            self._blow()
            self._solver.step(self.now, self.next, None, None, dt)
            self.now, self.next = self.next, self.now

    def _blow(self) -> None:
        """Let the gas press on the wall."""
        self.now.clear_forces()
        x, force = self.now.particle_q, self.now.particle_f
        for faces, space, sealed in zip(self._chambers, self._volumes, self._sealed, strict=True):
            space.zero_()
            wp.launch(add_volume, len(faces), inputs=[x, faces, space])
            wp.launch(press_wall, len(faces), inputs=[x, faces, space, sealed, ATMOSPHERE, force])


def wall_of_springs(walls: Walls, contact: float, *, faces: bool = False) -> Any:
    """Return a model of particles and springs; what is held has no inverse mass.

    `contact`: radius of a particle, m; `faces`: whether it has the triangles, too, without force.
    """
    rest, triangles = walls.rest, walls.triangles
    corners = rest[triangles]
    area = 0.5 * np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    mass = np.zeros(len(rest))
    np.add.at(mass, triangles, (area * wall_thickness() * LATEX_DENSITY / 3.0)[:, None])
    mass[walls.held.index] = 0.0
    builder = import_module("newton").ModelBuilder(gravity=(0.0, 0.0, 0.0))
    count = len(rest)
    builder.add_particles(
        pos=[wp.vec3(*p) for p in rest],
        vel=[wp.vec3(0.0)] * count,
        mass=mass.tolist(),
        radius=[contact] * count,
    )
    if faces:
        nothing = [0.0] * len(triangles)
        builder.add_triangles(*triangles.T.tolist(), tri_ke=nothing, tri_ka=nothing, tri_kd=nothing)
    for i, j in springs(walls.quads).tolist():
        builder.add_spring(i, j, SPRING, DAMPING, 0.0)
    if faces:
        builder.color()
    return builder.finalize(device="cpu")
