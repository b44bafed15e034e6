"""Pictures of balloons: a small ray caster on Warp, on the CPU or a CUDA device."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp

from balloon_usd.preview.balls import ball_tree, balls_of
from balloon_usd.preview.camera import Axes, frame_points
from balloon_usd.preview.device import drawing_device, opaque, vectors
from balloon_usd.preview.floor import bake_floor
from balloon_usd.preview.kernels.raycast import Scene, draw, light_vertices, smooth_edges
from balloon_usd.preview.lighting import DIRECTIONS, sphere_directions
from balloon_usd.preview.particles import Particles
from balloon_usd.preview.scenery import camera_of, light_directions, require_within_reach, studio_of
from balloon_usd.preview.shot import Shot

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from balloon_usd.preview.camera import Framing, View
    from balloon_usd.preview.kernels.balls import Balls
    from balloon_usd.preview.kernels.raycast import Camera
    from balloon_usd.preview.kernels.studio import Studio
    from balloon_usd.preview.shot import Picture
    from balloon_usd.preview.subdivide import Points
    from balloon_usd.preview.surface import SmoothSurface

SAMPLES = 3
"""Rays along each side of a pixel with an edge."""


class Raycaster:
    """Draws meshes of fixed topology; prepared once and then used for every frame."""

    def __init__(
        self,
        surfaces: Sequence[SmoothSurface],
        colors: Sequence[npt.ArrayLike],
        finishes: Sequence[npt.ArrayLike] | None = None,
        *,
        device: str = "auto",
    ) -> None:
        """Prepare the device.

        Args:
            surfaces: one a mesh.
            colors: one a mesh, linear rgb: (3,) or one row for each face of the cage (F, 3).
            finishes: one a mesh, metallic, opacity and shine (0..1) in the same form; None draws latex.
            device: cpu, cuda:N, or auto for the first CUDA device and else the CPU.
        """
        self._surfaces = tuple(surfaces)
        self._device = drawing_device(device)
        offsets = np.cumsum([0] + [s.vertex_count for s in surfaces])
        quads = np.concatenate([s.quads + o for s, o in zip(surfaces, offsets[:-1], strict=True)])
        triangles = quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3).astype(np.int32)
        self._plain = [_of_quads(c, s) for c, s in zip(colors, surfaces, strict=True)]
        with wp.ScopedDevice(self._device):
            self._triangles: Any = wp.array(triangles, dtype=wp.int32)
            self._colors = _of_triangles(self._plain)
            self._finishes = opaque(len(triangles))
            if finishes is not None:
                rows = [_of_quads(f, s) for f, s in zip(finishes, surfaces, strict=True)]
                self._finishes = _of_triangles(rows)
            self._directions = vectors(sphere_directions(DIRECTIONS))

    def paint(self, colors: Sequence[Points | None]) -> None:
        """Colour the frames that follow by vertex.

        Args:
            colors: one a mesh, linear rgb (V, 3) of the cage's points; None keeps the colours of its faces.
        """
        if all(by_vertex is None for by_vertex in colors):
            return
        painted = [
            plain if by_vertex is None else surface.refine(by_vertex)[surface.quads].mean(axis=1)
            for surface, plain, by_vertex in zip(self._surfaces, self._plain, colors, strict=True)
        ]
        with wp.ScopedDevice(self._device):
            self._colors = _of_triangles(painted)

    def shoot(
        self,
        points: Sequence[Points],
        view: View = "three-quarter",
        size: tuple[int, int] = (480, 320),
        particles: Particles | None = None,
        framing: Framing | None = None,
    ) -> Shot:
        """Draw one frame.

        Args:
            points: cage points (V, 3) of each mesh (m, z up).
            view: side, three-quarter, front-quarter, front or top.
            size: width and height (pixels).
            particles: drawn as balls where no wall hides them.
            framing: where the camera stands, for pictures that are compared; None lets all points fill the
                picture.

        Raises:
            PreviewError: a point is not finite or out of all reach.
        """
        balls = particles or Particles.none()
        used = [s.used_points(p) for s, p in zip(self._surfaces, points, strict=True)]
        require_within_reach(np.concatenate([*used, balls.bounds]))
        refined = [s.spread(u) for s, u in zip(self._surfaces, used, strict=True)]
        everything = np.concatenate([*refined, balls.bounds])
        axes = Axes.of(view)
        framing = framing or frame_points(everything, axes, size[0] / size[1])
        with wp.ScopedDevice(self._device):
            # The mesh and the tree must outlive every launch that knows their ids.
            mesh = wp.Mesh(vectors(np.concatenate(refined)), self._triangles.flatten())
            tree = ball_tree(balls)
            studio = studio_of(axes, float(everything[:, 2].min()))
            camera = camera_of(framing, axes)
            scene = self._scene(mesh, studio, camera, refined, balls_of(balls, tree))
            seen = [scene, studio, camera, bake_floor(everything, scene, studio.floor)]
            picture = _develop(seen, size)
        return Shot(picture, 2.0 * framing.half_height * framing.distance / size[1])

    def _scene(
        self, mesh: wp.Mesh, studio: Studio, camera: Camera, refined: Sequence[Points], balls: Balls
    ) -> Scene:
        """Gather what the kernels need, with the light baked into the vertices."""
        normals = [s.normals(r) for s, r in zip(self._surfaces, refined, strict=True)]
        scene = Scene()
        scene.mesh = mesh.id
        scene.triangles = self._triangles
        scene.normals = vectors(np.concatenate(normals))
        scene.colors = self._colors
        scene.finishes = self._finishes
        scene.balls = balls
        light_directions(scene, studio, self._directions)
        scene.light = self._light(scene, camera, refined, normals)
        return scene

    def _light(
        self, scene: Scene, camera: Camera, refined: Sequence[Points], normals: Sequence[Points]
    ) -> Any:
        """Bake the light at the vertices of the cages, where it is cheap, and spread it to all others."""
        counts = [s.cage_count for s in self._surfaces]
        places = vectors(np.concatenate([p[:n] for p, n in zip(refined, counts, strict=True)]))
        facing = vectors(np.concatenate([p[:n] for p, n in zip(normals, counts, strict=True)]))
        gathered: Any = wp.empty_like(places)
        wp.launch(light_vertices, dim=len(places), inputs=[scene, camera.eye, places, facing, gathered])
        shares = np.split(gathered.numpy(), np.cumsum(counts)[:-1])
        return vectors(np.concatenate([s.spread(g) for s, g in zip(self._surfaces, shares, strict=True)]))


def _of_triangles(quads: Sequence[npt.NDArray[np.float32]]) -> Any:
    """Copy rows (Q, 3) of the quads of all meshes to the current device, for each of their two triangles."""
    return vectors(np.repeat(np.concatenate(quads), 2, axis=0))


def _of_quads(given: npt.ArrayLike, surface: SmoothSurface) -> npt.NDArray[np.float32]:
    """Return a row for every refined quad (Q, 3), of one row (3,) or one for each face of the cage (F, 3)."""
    rows = np.asarray(given, dtype=np.float32)
    if rows.ndim == 1:
        return np.broadcast_to(rows, (len(surface.quads), 3))
    return rows[surface.cage_face]


def _develop(seen: list[object], size: tuple[int, int]) -> Picture:
    """Draw what the camera sees, (height, width, 3), and its edges once more."""
    picture: Any = wp.empty((size[1], size[0]), dtype=wp.vec3)
    smoothed: Any = wp.empty_like(picture)
    wp.launch(draw, dim=picture.shape, inputs=[*seen, picture])
    wp.launch(smooth_edges, dim=picture.shape, inputs=[*seen, SAMPLES, picture, smoothed])
    return np.asarray(np.rint(smoothed.numpy() * 255.0), dtype=np.uint8)
