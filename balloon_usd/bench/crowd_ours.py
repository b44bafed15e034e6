"""The crowd of tubes, by the latex solver."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.bench.crowd_task import TUBES, CrowdRun
from balloon_usd.bench.frame_clock import clock_frames
from balloon_usd.bench.pinch_ours import COARSE, HELD_MASS, SUBSTEPS
from balloon_usd.bench.pinch_task import FPS, GAUGE, PINCHED, RADIUS
from balloon_usd.bench.pinch_wall import blown_up, wall_thickness
from balloon_usd.processes.cores import usable_cores
from balloon_usd.solver.latex.body import LatexBody
from balloon_usd.solver.latex.controls import LatexControls
from balloon_usd.solver.latex.scene import build_scene
from balloon_usd.solver.latex.spins import VertexSet
from balloon_usd.solver.latex.stepper import Stepper
from balloon_usd.solver.settings import SceneSettings

if TYPE_CHECKING:
    from balloon_usd.bench.crowd_task import CrowdTask
    from balloon_usd.bench.pinch_task import Floats


class CrowdOfTubes:
    """The tubes in a scene of their own, and the hands on them."""

    def __init__(self, task: CrowdTask, substeps: int, device: str, *, contact: bool) -> None:
        """Begin with the tubes side by side; `contact`: whether their walls touch."""
        self._task, self._contact = task, contact
        bodies = [_tube(task, axis) for axis in task.axes]
        settings = SceneSettings(dt=1.0 / (FPS * substeps))
        self._scene = build_scene(bodies, [0] * TUBES, settings, device, 1, 1)
        mass = self._scene.mass.numpy()
        mass[np.concatenate(task.ends)] *= HELD_MASS
        self._scene.mass.assign(mass)
        self._stepper = Stepper(self._scene, substeps, usable_cores())
        self._hands = LatexControls(self._scene)
        if contact:
            self._hands.touch(range(TUBES))
        self._ends = [VertexSet.of(end) for end in task.ends]

    def points(self) -> Floats:
        """Where all vertices are, (V, 3), m."""
        return np.array(self._scene.x.numpy(), dtype=np.float64)

    def act(self, frame: int) -> None:
        """Do what the task says for a frame."""
        rate = 0.5 * (self._task.turn_at(frame + 1) - self._task.turn_at(frame)) * FPS
        if rate > 0.0:
            for end, along in zip(self._ends, (-1.0, 1.0), strict=True):
                spin = {"point": (0.0, 0.0, 0.0), "axis": (along, 0.0, 0.0), "rate": rate, "free": 1}
                self._hands.spins.turn(end, spin)
        self._hands.upload()
        self._stepper.advance(contact=self._contact)
        self._hands.arrived()
        self._hands.spins.stop()


def _tube(task: CrowdTask, axis: Floats) -> LatexBody:
    """Return one tube as it was blown up, along an axis through a place (3,), m."""
    mesh, rubber, state = task.tube, rubber_named(), blown_up()
    faces, radius = len(mesh.quads), RADIUS / state.a
    nearest = np.abs(mesh.along[:, None] - mesh.ring_along[None, :]).argmin(axis=1)
    return LatexBody(
        points=(mesh.points + axis).astype(np.float32),
        rest=mesh.points.astype(np.float64) / np.array([state.b, state.a, state.a]),
        quads=mesh.quads,
        thickness=np.full(faces, wall_thickness()),
        rubber=rubber,
        worked=np.full(faces, float(rubber.energy(state.a, state.b))),
        radius=radius,
        along=(mesh.along / state.b).astype(np.float32),
        mesh_rings=tuple((int(first), mesh.around) for first in mesh.ring_start),
        vertex_ring=nearest.astype(np.int32),
        rings=(),
        segment_ends=np.array([faces], dtype=np.int32),
        gauge=np.array([GAUGE]),
        vented=(),
        inlet=0,
        neck_radius=PINCHED * RADIUS,
    )


def run_ours(task: CrowdTask, device: str, *, contact: bool = True) -> CrowdRun:
    """Let the tubes be turned; `contact`: whether their walls touch."""
    substeps = max(SUBSTEPS * task.around // COARSE, SUBSTEPS)
    tubes = CrowdOfTubes(task, substeps, device, contact=contact)
    shapes: list[Floats] = []
    seconds = clock_frames(tubes.act, task.frames, lambda: shapes.append(tubes.points()))
    return CrowdRun(tuple(shapes), substeps, *seconds)
