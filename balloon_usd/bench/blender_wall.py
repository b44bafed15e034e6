"""A wall of springs with gas inside, and hands on it, for Blender's cloth: one gas for all chambers."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.balloon.rubber import LATEX_DENSITY
from balloon_usd.bench.pinch_shape import volume
from balloon_usd.bench.pinch_task import FPS, GAUGE
from balloon_usd.bench.pinch_wall import SPRING, wall_thickness

if TYPE_CHECKING:
    from balloon_usd.bench.pinch_task import Floats
    from balloon_usd.bench.walls import Walls

STEPS = 5
"""Cloth's steps in a frame, its own default."""
MOST_PRESSURE = 10_000.0
"""Largest ambient pressure that cloth takes, Pa: a tenth of the atmosphere, so its gas is softer than air."""
CONTACT = 1.5e-3
"""Distance that self-contact keeps, m."""


class BlenderWall:
    """Walls as a cloth object in a scene of its own."""

    def __init__(self, walls: Walls) -> None:
        """Begin with the walls as they are blown up."""
        bpy: Any = import_module("bpy")
        self._count = len(walls.points)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.scene = bpy.context.scene
        self.scene.render.fps = round(FPS)
        self.scene.use_gravity = False
        self.scene.frame_start, self.scene.frame_end = 1, walls.frames + 1
        mesh = bpy.data.meshes.new("tube")
        mesh.from_pydata(walls.points.tolist(), [], walls.quads.tolist())
        self.tube = bpy.data.objects.new("tube", mesh)
        self.scene.collection.objects.link(self.tube)
        held = walls.held
        group = self.tube.vertex_groups.new(name="held")
        group.add(held.index.tolist(), 1.0, "REPLACE")
        _animate(self.tube, walls)
        cloth = self.tube.modifiers.new("cloth", "CLOTH")
        _stitch(cloth, walls, self.tube)
        cloth.point_cache.frame_start, cloth.point_cache.frame_end = 1, walls.frames + 1
        self.scene.frame_set(1)

    def advance(self, frame: int) -> None:
        """Do what the task says for a frame."""
        self.scene.frame_set(frame + 2)
        self.points()

    def points(self) -> Floats:
        """Where all vertices are, (V, 3), m."""
        bpy: Any = import_module("bpy")
        shown = self.tube.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        flat = np.empty(3 * self._count, dtype=np.float32)
        shown.vertices.foreach_get("co", flat)
        return flat.reshape(-1, 3).astype(np.float64)


def _animate(tube: Any, walls: Walls) -> None:
    """Make shape keys that carry what is held, one for each frame, and one of the unstressed wall."""
    tube.shape_key_add(name="start")
    tube.shape_key_add(name="rest").data.foreach_set("co", walls.rest.astype(np.float32).ravel())
    points = walls.points.astype(np.float32)
    for frame in range(1, walls.frames + 1):
        points[walls.held.index] = walls.held.places(frame)
        key = tube.shape_key_add(name=f"frame {frame}")
        key.data.foreach_set("co", points.ravel())
        # Keys fade into each other: between two frames what is held moves straight.
        for at, value in ((frame - 1, 0.0), (frame, 1.0), (frame + 1, 0.0)):
            key.value = value
            key.keyframe_insert("value", frame=at + 1)
    for curve in tube.data.shape_keys.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def _stitch(cloth: Any, walls: Walls, tube: Any) -> None:
    """Give the cloth the wall, the gas and the contact of the task."""
    sides = walls.points[walls.quads].astype(np.float64)
    length = float(np.linalg.norm(sides - np.roll(sides, 1, axis=1), axis=2).mean())
    area = 0.5 * np.linalg.norm(np.cross(sides[:, 2] - sides[:, 0], sides[:, 3] - sides[:, 1]), axis=1)
    settings = cloth.settings
    settings.quality = STEPS
    settings.mass = float(area.sum()) * wall_thickness() * LATEX_DENSITY / len(walls.points)
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
    settings.target_volume = volume(walls.points, walls.triangles)
    cloth.collision_settings.use_collision = False
    cloth.collision_settings.use_self_collision = True
    cloth.collision_settings.self_distance_min = CONTACT
