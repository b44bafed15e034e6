"""Render a stage as Blender imports it: Cycles, a studio with soft light, the last frame.

python tests/blender/render_dog.py STAGE PICTURE
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

WIDTH, SAMPLES = 960, 64
HEIGHT = 2 / 3
"""In widths."""
LENS = 70.0
"""Focal length on a 36 mm sensor: as a portrait is taken."""
FROM = Vector((-0.78, -1.0, 0.30))
"""Direction from the sculpture to the camera: its face, a little from above."""
MARGIN = 1.10
"""Room around the sculpture, in its own size."""
PAPER = (0.70, 0.79, 0.82, 1.0)
SUBDIVISIONS = 3
EXPOSURE = 0.35


def bring_in(stage: Path) -> list[bpy.types.Object]:
    """Import the stage at its last frame and return its meshes."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    given = bpy.ops.wm.usd_import.get_rna_type().properties.keys()
    subdivision = "import_subdivision" if "import_subdivision" in given else "import_subdiv"
    bpy.ops.wm.usd_import(filepath=str(stage), **{subdivision: True})
    scene = bpy.context.scene
    scene.frame_set(scene.frame_end)
    meshes = [thing for thing in scene.objects if thing.type == "MESH"]
    for mesh in meshes:
        for modifier in mesh.modifiers:
            if modifier.type == "SUBSURF":
                modifier.levels = modifier.render_levels = SUBDIVISIONS
    return meshes


def corners(meshes: list[bpy.types.Object]) -> np.ndarray:
    """Every vertex of the meshes as drawn, (V, 3), m."""
    graph = bpy.context.evaluated_depsgraph_get()
    found = []
    for mesh in meshes:
        drawn = mesh.evaluated_get(graph).data
        points = np.empty(3 * len(drawn.vertices), dtype=np.float32)
        drawn.vertices.foreach_get("co", points)
        found.append(
            points.reshape(-1, 3) @ np.array(mesh.matrix_world.to_3x3()).T + mesh.matrix_world.translation
        )
    return np.concatenate(found)


def aim(thing: bpy.types.Object, at: Vector) -> None:
    """Turn a camera or a light towards a point."""
    thing.rotation_euler = (at - thing.location).to_track_quat("-Z", "Y").to_euler()


def put_camera(points: np.ndarray) -> None:
    """Frame the points (V, 3) as large as they fit."""
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene = bpy.context.scene
    scene.collection.objects.link(camera)
    scene.camera = camera
    camera.data.lens = LENS
    middle = Vector((points.min(axis=0) + points.max(axis=0)) / 2)
    camera.location = middle + FROM.normalized()
    aim(camera, middle)
    bpy.context.view_layer.update()
    # Twice: once the sculpture is near, its nearer parts look larger.
    for _ in range(2):
        place, _ = camera.camera_fit_coords(bpy.context.evaluated_depsgraph_get(), points.ravel().tolist())
        camera.location = place
        bpy.context.view_layer.update()
    toward = camera.matrix_world.to_quaternion() @ Vector((0.0, 0.0, 1.0))
    camera.location += toward * (MARGIN - 1.0) * (camera.location - middle).length


def put_light(
    name: str, place: Vector, at: Vector, size: float, watts: float, color: tuple[float, float, float]
) -> None:
    """Add a soft box."""
    light = bpy.data.lights.new(name, "AREA")
    light.shape, light.size, light.energy, light.color = "DISK", size, watts, color
    lamp = bpy.data.objects.new(name, light)
    bpy.context.scene.collection.objects.link(lamp)
    lamp.location = place
    aim(lamp, at)


def put_studio(points: np.ndarray) -> None:
    """Set ground, backdrop and lights around the points (V, 3)."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, size = Vector((low + high) / 2), float(np.linalg.norm(high - low))
    put_paper(Vector((middle.x, middle.y, low[2])), size)
    left = FROM.cross(Vector((0.0, 0.0, 1.0))).normalized()
    front = Vector((FROM.x, FROM.y, 0.0)).normalized()
    up = Vector((0.0, 0.0, 1.0))
    put_light(
        "wall",
        middle + size * (3.0 * up - 1.5 * front),
        middle - size * 4.0 * front,
        2.5 * size,
        75.0 * size**2,
        (1.0, 1.0, 1.0),
    )
    for name, place, wide, watts, color in (
        ("key", -0.9 * left + 0.9 * front + 1.6 * up, 0.9, 34.0, (1.0, 0.96, 0.91)),
        ("fill", 1.9 * left + 0.6 * front + 0.6 * up, 0.9, 5.0, (0.90, 0.95, 1.0)),
        ("rim", 0.6 * left - 1.3 * front + 1.4 * up, 0.6, 28.0, (1.0, 1.0, 1.0)),
    ):
        put_light(name, middle + size * place, middle, size * wide, watts * size**2, color)
    world = bpy.data.worlds.new("studio")
    bpy.context.scene.world = world
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.9, 0.95, 1.0, 1.0)
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.10


def put_paper(foot: Vector, size: float) -> None:
    """Lay a sheet of paper that bends up behind the sculpture."""
    away = -Vector((FROM.x, FROM.y, 0.0)).normalized()
    aside = away.cross(Vector((0.0, 0.0, 1.0)))
    bend, far, wide = 1.2 * size, 2.5 * size, 12.0 * size
    profile = [(-8.0 * size, 0.0), (far, 0.0)]
    profile += [
        (far + bend * math.sin(a), bend * (1.0 - math.cos(a))) for a in np.linspace(0.0, math.pi / 2, 24)[1:]
    ]
    profile += [(far + bend, 8.0 * size)]
    rows = [
        [foot + away * x + aside * side + Vector((0.0, 0.0, z)) for side in (-wide, wide)] for x, z in profile
    ]
    sheet = bpy.data.meshes.new("paper")
    quads = [(2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2) for k in range(len(rows) - 1)]
    sheet.from_pydata([point for row in rows for point in row], [], quads)
    sheet.shade_smooth()
    material = bpy.data.materials.new("paper")
    material.use_nodes = True
    surface = material.node_tree.nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value = PAPER
    surface.inputs["Roughness"].default_value = 0.9
    sheet.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("paper", sheet))


def settle(width: int, samples: int) -> None:
    """Choose few samples and take the noise out."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = True
    scene.cycles.denoiser = "OPENIMAGEDENOISE"
    scene.render.resolution_x, scene.render.resolution_y = width, round(HEIGHT * width)
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.compression = 100
    # Noise that hides steps of grey doubles the file.
    scene.render.dither_intensity = 0.0
    scene.view_settings.view_transform = "AgX"
    scene.view_settings.exposure = EXPOSURE
    scene.view_settings.look = "AgX - Medium High Contrast"


def main(stage: str, picture: str, width: int = WIDTH, samples: int = SAMPLES) -> None:
    """Render the last frame of a stage into a PNG."""
    points = corners(bring_in(Path(stage)))
    settle(width, samples)
    put_camera(points)
    put_studio(points)
    bpy.context.scene.render.filepath = str(Path(picture).absolute())
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
