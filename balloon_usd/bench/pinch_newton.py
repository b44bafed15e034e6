"""The task of pinch and turn, by Newton's solver XPBD (position-based springs, spheres for self-contact)."""

from __future__ import annotations

import statistics
import time
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.balloon.rubber import LATEX_DENSITY
from balloon_usd.bench.kernels.sealed_tube import add_volume, hold, press_wall
from balloon_usd.bench.pinch_shape import volume
from balloon_usd.bench.pinch_task import FPS, PinchRun
from balloon_usd.bench.pinch_wall import SEALED, SPRING, HeldVertices, rest_points, springs, wall_thickness

if TYPE_CHECKING:
    from balloon_usd.bench.pinch_task import Floats, PinchTask

SUBSTEPS = 256
"""Substeps in a frame: with fewer the gas, an outer force to this solver, shakes the wall apart."""
ITERATIONS = 1
"""Relaxations in a substep: small steps need no more (Macklin et al. 2019)."""
CONTACT = 0.75e-3
"""Radius of the spheres that stand for the wall in self-contact, m."""
DAMPING = 0.02
"""Damping of a spring, N s/m: calms the gas without slowing the hands."""


class NewtonTube:
    """The tube as particles and springs, with gas and hands added."""

    def __init__(self, task: PinchTask) -> None:
        self.held = HeldVertices(task)
        start = task.mesh.points.astype(np.float64)
        self.model = _model(task, self.held)
        self.solver = import_module("newton.solvers").SolverXPBD(self.model, iterations=ITERATIONS)
        self.now, self.next = self.model.state(), self.model.state()
        for state in (self.now, self.next):
            state.particle_q.assign(start.astype(np.float32))
        self._triangles: Any = wp.array(task.triangles.astype(np.int32), dtype=int)
        self._volume: Any = wp.zeros(1, dtype=float)
        self._sealed = SEALED * volume(start, task)
        self._index: Any = wp.array(self.held.index, dtype=int)
        self._start: Any = wp.array(start[self.held.index].astype(np.float32), dtype=wp.vec3)
        self._pinch, self._turn = (wp.zeros(len(self.held.index), dtype=wp.vec2) for _ in range(2))

    def points(self) -> Floats:
        """Where all vertices are, (V, 3), m."""
        return np.array(self.now.particle_q.numpy(), dtype=np.float64)

    def advance(self, frame: int) -> None:
        """Do what the task says for a frame."""
        dt = 1.0 / (FPS * SUBSTEPS)
        before, after = self.held.at(frame), self.held.at(frame + 1)
        for way, begin, end in zip((self._pinch, self._turn), before, after, strict=True):
            way.assign(np.column_stack([begin, end]).astype(np.float32))
        hands = [self._index, self._start, self._pinch, self._turn]
        for k in range(SUBSTEPS):
            held = [(k + 1) / SUBSTEPS, self.now.particle_q, self.now.particle_qd]
            wp.launch(hold, len(self.held.index), inputs=[*hands, *held])
            self._blow()
            self.solver.step(self.now, self.next, None, None, dt)
            self.now, self.next = self.next, self.now

    def _blow(self) -> None:
        """Let the gas press on the wall."""
        self.now.clear_forces()
        self._volume.zero_()
        x, faces = self.now.particle_q, self._triangles
        wp.launch(add_volume, len(faces), inputs=[x, faces, self._volume])
        inputs = [x, faces, self._volume, self._sealed, ATMOSPHERE, self.now.particle_f]
        wp.launch(press_wall, len(faces), inputs=inputs)


def _model(task: PinchTask, held: HeldVertices) -> Any:
    """Particles and springs of the tube; what is held has no inverse mass."""
    rest = rest_points(task)
    corners = rest[task.triangles]
    area = 0.5 * np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    mass = np.zeros(len(rest))
    np.add.at(mass, task.triangles, (area * wall_thickness() * LATEX_DENSITY / 3.0)[:, None])
    mass[held.index] = 0.0
    builder = import_module("newton").ModelBuilder(gravity=(0.0, 0.0, 0.0))
    count = len(rest)
    builder.add_particles(
        pos=[wp.vec3(*p) for p in rest],
        vel=[wp.vec3(0.0)] * count,
        mass=mass.tolist(),
        radius=[CONTACT] * count,
    )
    for i, j in springs(task).tolist():
        builder.add_spring(i, j, SPRING, DAMPING, 0.0)
    return builder.finalize(device="cpu")


def run_newton(task: PinchTask) -> PinchRun:
    """Do the task on the CPU."""
    with wp.ScopedDevice("cpu"):
        tube = NewtonTube(task)
        start, wall, cpu = tube.points(), [], []
        for frame in range(task.frames):
            clocks = time.perf_counter(), time.process_time()
            tube.advance(frame)
            wall.append(time.perf_counter() - clocks[0])
            cpu.append(time.process_time() - clocks[1])
    return PinchRun(
        start, tube.points(), SUBSTEPS, 1e3 * statistics.median(wall), 1e3 * statistics.median(cpu)
    )
