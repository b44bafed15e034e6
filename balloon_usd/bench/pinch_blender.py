"""The task of pinch and turn, by Blender's cloth (springs, implicit steps, repulsion for self-contact)."""

from __future__ import annotations

import statistics
import time
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.balloon.rubber import LATEX_DENSITY
from balloon_usd.bench.pinch_shape import volume
from balloon_usd.bench.pinch_task import FPS, GAUGE, PinchRun
from balloon_usd.bench.pinch_wall import SPRING, HeldVertices, rest_points, wall_thickness

if TYPE_CHECKING:
    from balloon_usd.bench.pinch_task import Floats, PinchTask

STEPS = 5
"""Cloth's steps in a frame, its own default."""
MOST_PRESSURE = 10_000.0
"""Largest ambient pressure that cloth takes, Pa: a tenth of the atmosphere, so its gas is softer than air."""
CONTACT = 1.5e-3
"""Distance that self-contact keeps, m."""


class BlenderTube:
    """The tube as a cloth object in a scene of its own."""

    def __init__(self, task: PinchTask) -> None:
        bpy: Any = import_module("bpy")
        self.task = task
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.scene = bpy.context.scene
        self.scene.render.fps = round(FPS)
        self.scene.use_gravity = False
        self.scene.frame_start, self.scene.frame_end = 1, task.frames + 1
        mesh = bpy.data.meshes.new("tube")
        mesh.from_pydata(task.mesh.points.tolist(), [], task.mesh.quads.tolist())
        self.tube = bpy.data.objects.new("tube", mesh)
        self.scene.collection.objects.link(self.tube)
        held = HeldVertices(task)
        group = self.tube.vertex_groups.new(name="held")
        group.add(held.index.tolist(), 1.0, "REPLACE")
        _animate(self.tube, task, held)
        cloth = self.tube.modifiers.new("cloth", "CLOTH")
        _stitch(cloth, task, self.tube)
        cloth.point_cache.frame_start, cloth.point_cache.frame_end = 1, task.frames + 1
        self.scene.frame_set(1)

    def advance(self, frame: int) -> None:
        """Do what the task says for a frame."""
        self.scene.frame_set(frame + 2)
        self.points()

    def points(self) -> Floats:
        """Where all vertices are, (V, 3), m."""
        bpy: Any = import_module("bpy")
        shown = self.tube.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        flat = np.empty(3 * self.task.vertices, dtype=np.float32)
        shown.vertices.foreach_get("co", flat)
        return flat.reshape(-1, 3).astype(np.float64)


def _animate(tube: Any, task: PinchTask, held: HeldVertices) -> None:
    """Make shape keys that carry what is held, one for each frame, and one of the unstressed wall."""
    tube.shape_key_add(name="start")
    tube.shape_key_add(name="rest").data.foreach_set("co", rest_points(task).astype(np.float32).ravel())
    points = task.mesh.points.copy()
    for frame in range(1, task.frames + 1):
        points[held.index] = held.places(frame)
        key = tube.shape_key_add(name=f"frame {frame}")
        key.data.foreach_set("co", points.ravel())
        # Keys fade into each other: between two frames what is held moves straight.
        for at, value in ((frame - 1, 0.0), (frame, 1.0), (frame + 1, 0.0)):
            key.value = value
            key.keyframe_insert("value", frame=at + 1)
    for curve in tube.data.shape_keys.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def _stitch(cloth: Any, task: PinchTask, tube: Any) -> None:
    """Give the cloth the wall, the gas and the contact of the task."""
    sides = task.mesh.points[task.mesh.quads].astype(np.float64)
    length = float(np.linalg.norm(sides - np.roll(sides, 1, axis=1), axis=2).mean())
    area = 0.5 * np.linalg.norm(np.cross(sides[:, 2] - sides[:, 0], sides[:, 3] - sides[:, 1]), axis=1)
    settings = cloth.settings
    settings.quality = STEPS
    settings.mass = float(area.sum()) * wall_thickness() * LATEX_DENSITY / task.vertices
    # Cloth divides stiffnesses by the mean length of its springs.
    for name in ("tension", "compression", "shear"):
        setattr(settings, f"{name}_stiffness", SPRING * length)
    settings.bending_stiffness = 0.0
    settings.vertex_group_mass = "held"
    settings.pin_stiffness = 1.0
    settings.rest_shape_key = tube.data.shape_keys.key_blocks["rest"]
    settings.use_pressure = settings.use_pressure_volume = True
    # It is multiplied by the pressure factor, too.
    settings.uniform_pressure_force = GAUGE / MOST_PRESSURE
    settings.pressure_factor = MOST_PRESSURE
    settings.target_volume = volume(task.mesh.points.astype(np.float64), task)
    cloth.collision_settings.use_collision = False
    cloth.collision_settings.use_self_collision = True
    cloth.collision_settings.self_distance_min = CONTACT


def run_blender(task: PinchTask) -> PinchRun:
    """Do the task."""
    tube = BlenderTube(task)
    start, wall, cpu = tube.points(), [], []
    for frame in range(task.frames):
        clocks = time.perf_counter(), time.process_time()
        tube.advance(frame)
        wall.append(time.perf_counter() - clocks[0])
        cpu.append(time.process_time() - clocks[1])
    return PinchRun(start, tube.points(), STEPS, 1e3 * statistics.median(wall), 1e3 * statistics.median(cpu))
