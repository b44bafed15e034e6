"""The task of pinch and turn, by the latex solver."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.bench.frame_clock import clock_frames
from balloon_usd.bench.pinch_task import FPS, GAUGE, PINCHED, RADIUS, PinchRun
from balloon_usd.bench.pinch_wall import blown_up, rest_points, wall_thickness
from balloon_usd.processes.cores import usable_cores
from balloon_usd.solver.body import RingSpec
from balloon_usd.solver.kernels.physics.gas import OPEN_PASSAGE
from balloon_usd.solver.latex.body import LatexBody
from balloon_usd.solver.latex.controls import LatexControls
from balloon_usd.solver.latex.scene import build_scene
from balloon_usd.solver.latex.spins import VertexSet
from balloon_usd.solver.latex.stepper import Stepper
from balloon_usd.solver.settings import SceneSettings

if TYPE_CHECKING:
    from balloon_usd.bench.pinch_task import Floats, PinchTask

COARSE = 32
"""Vertices round the coarsest tube."""
SUBSTEPS = 16
"""Substeps in a frame of the coarsest tube: fewer, and the wall lags behind the hands."""
HELD_MASS = 1.0e6
"""Mass of what hands hold, in that of free wall: nothing moves it."""
SETTLING = 30
"""Frames in which the tube comes to rest before the pinch."""


class PinchedTube:
    """The tube in a scene of its own, and the hands on it."""

    def __init__(self, task: PinchTask, substeps: int, device: str) -> None:
        self.task = task
        self.neck = task.pinched
        body = tube_body(task)
        settings = SceneSettings(dt=1.0 / (FPS * substeps))
        self.scene = build_scene([body], [0], settings, device, 1, 1)
        mass = self.scene.mass.numpy()
        mass[np.concatenate(task.ends)] *= HELD_MASS
        self.scene.mass.assign(mass)
        self.stepper = Stepper(self.scene, substeps, usable_cores())
        self.hands = LatexControls(self.scene)
        self.hands.touch([0])
        self._whole = np.full(len(self.neck), RADIUS)
        middle = task.middle
        beyond = body.along > float(body.along[task.mesh.ring_start[middle : middle + 2]].mean())
        self._halves = [VertexSet.of(np.flatnonzero(side)) for side in (beyond, ~beyond)]

    def advance(self) -> None:
        """Advance by one frame."""
        self.hands.upload()
        self.stepper.advance(contact=True)
        self.hands.arrived()

    def points(self) -> Floats:
        """Where all vertices are, (V, 3), m."""
        return np.array(self.scene.x.numpy(), dtype=np.float64)

    def take_hold(self) -> None:
        """Take the middle of the tube between the fingers."""
        rings = self.points()[[self.task.ring(k) for k in self.neck]]
        arms = np.linalg.norm(rings - rings.mean(axis=1, keepdims=True), axis=2)
        self._whole = arms.mean(axis=1)
        self.hands.radius[:] = self._whole
        self.hands.clasp(len(self.neck) // 2, self.scene.ring_middle.numpy())

    def act(self, frame: int) -> None:
        """Do what the task says for a frame, and advance."""
        for joint in range(len(self.neck)):
            self.hands.squeeze(joint, float(self._whole[joint]) * self.task.pinch_at(frame), OPEN_PASSAGE)
        angle = self.task.turn_at(frame) - self.task.turn_at(frame - 1)
        if angle > 0.0:
            self._turn(0.5 * angle * FPS)
        self.advance()

    def _turn(self, rate: float) -> None:
        """Turn both ends at a rate (rad/s) in this frame, against each other."""
        point = self.scene.ring_middle.numpy()[len(self.neck) // 2]
        for half, along in zip(self._halves, (1.0, -1.0), strict=True):
            spin = {"point": point, "axis": (along, 0.0, 0.0), "rate": rate, "free": 1}
            self.hands.spins.turn(half, spin)


def tube_body(task: PinchTask) -> LatexBody:
    """Return the tube as it was blown up, of a wall that holds the task's pressure."""
    mesh, rubber, state, neck = task.mesh, rubber_named(), blown_up(), task.pinched
    radius = RADIUS / state.a
    faces, cap = len(mesh.quads), (mesh.around // 4) ** 2
    nearest = np.abs(mesh.along[:, None] - mesh.ring_along[None, :]).argmin(axis=1)
    return LatexBody(
        points=mesh.points,
        rest=rest_points(mesh),
        quads=mesh.quads,
        thickness=np.full(faces, wall_thickness()),
        rubber=rubber,
        worked=np.full(faces, float(rubber.energy(state.a, state.b))),
        radius=radius,
        along=(mesh.along / state.b).astype(np.float32),
        mesh_rings=tuple((int(first), mesh.around) for first in mesh.ring_start),
        vertex_ring=nearest.astype(np.int32),
        rings=tuple(RingSpec(int(mesh.ring_start[k]), mesh.around, parts=True, folds=False) for k in neck),
        segment_ends=np.array([*(cap + k * mesh.around for k in neck), faces], dtype=np.int32),
        gauge=np.full(len(neck) + 1, GAUGE),
        vented=(),
        inlet=0,
        neck_radius=PINCHED * RADIUS,
        packs=True,
    )


def substeps_for(task: PinchTask) -> int:
    """Return the substeps in a frame that the mesh of a task needs."""
    return SUBSTEPS * task.mesh.around // COARSE


def run_ours(task: PinchTask, substeps: int, device: str) -> PinchRun:
    """Do the task with so many substeps in a frame."""
    tube = PinchedTube(task, substeps, device)
    for _ in range(SETTLING):
        tube.advance()
    start = tube.points()
    tube.take_hold()
    seconds = clock_frames(tube.act, task.frames)
    return PinchRun(start, tube.points(), substeps, *seconds)
