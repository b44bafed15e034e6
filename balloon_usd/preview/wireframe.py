"""Pictures as in Kosaka 2008, chapter 4: the springs as orange wire, the air in them as balls."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp

from balloon_usd.preview.camera import Axes, frame_points
from balloon_usd.preview.device import drawing_device, opaque, vectors
from balloon_usd.preview.floor import bake_floor
from balloon_usd.preview.kernels.raycast import Floor, Scene
from balloon_usd.preview.kernels.wire import Sheet, draw_sheet
from balloon_usd.preview.lens import Lens
from balloon_usd.preview.lighting import DIRECTIONS, sphere_directions
from balloon_usd.preview.particles import Particles
from balloon_usd.preview.scenery import camera_of, light_directions, require_within_reach, studio_of
from balloon_usd.preview.shot import Shot
from balloon_usd.preview.strokes import Strokes, ball_strokes, wire_strokes
from balloon_usd.preview.tiles import TILE, strokes_by_tile, tiles_across

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from balloon_usd.preview.cage import Cage
    from balloon_usd.preview.camera import View
    from balloon_usd.preview.kernels.studio import Studio
    from balloon_usd.preview.subdivide import Points

NET_SHADOW = 0.3
"""Darkness of the shadow of a net, as a share of that of a closed wall."""


class Wireframe:
    """Draws cages of fixed topology as wire, and balls in them; prepared once, used for every frame."""

    def __init__(
        self, cages: Sequence[Cage], colors: Sequence[npt.NDArray[np.float32]], *, device: str = "auto"
    ) -> None:
        """Prepare the device.

        Args:
            cages: one a mesh.
            colors: one a mesh, linear rgb of each face (F, 3).
            device: cpu, cuda:N, or auto for the first CUDA device and else the CPU.

        Raises:
            PreviewError: there is no such device.
        """
        self._cages = tuple(cages)
        self._colors = [cage.edge_values(c) for cage, c in zip(cages, colors, strict=True)]
        self._device = drawing_device(device)
        offsets = np.cumsum([0] + [cage.used_count for cage in cages])
        fans = [cage.triangles() for cage in cages]
        triangles = [fan + offset for (fan, _), offset in zip(fans, offsets[:-1], strict=True)]
        walls = [rows[faces] for rows, (_, faces) in zip(colors, fans, strict=True)]
        with wp.ScopedDevice(self._device):
            self._triangles: Any = wp.array(np.concatenate(triangles).ravel(), dtype=wp.int32)
            self._walls = vectors(np.concatenate(walls))
            self._directions = vectors(sphere_directions(DIRECTIONS))

    def shoot(
        self,
        points: Sequence[Points],
        view: View = "three-quarter",
        size: tuple[int, int] = (480, 320),
        particles: Particles | None = None,
    ) -> Shot:
        """Draw one frame.

        Args:
            points: cage points (V, 3) of each mesh (m, z up).
            view: side, three-quarter, front-quarter, front or top.
            size: width and height (pixels).
            particles: drawn as balls inside the wire.

        Raises:
            PreviewError: a point is not finite or out of all reach.
        """
        balls = particles or Particles.none()
        used = [cage.used_points(p) for cage, p in zip(self._cages, points, strict=True)]
        everything = np.concatenate([*used, balls.bounds])
        require_within_reach(everything)
        axes = Axes.of(view)
        lens = Lens(axes, frame_points(everything, axes, size[0] / size[1]), size)
        strokes = self._strokes(lens, used, balls, everything)
        with wp.ScopedDevice(self._device):
            studio = studio_of(axes, float(everything[:, 2].min()))
            floor = self._floor(np.concatenate(used), everything, studio)
            seen = [_sheet(strokes, size), camera_of(lens.framing, axes), floor, studio.floor]
            picture: Any = wp.empty((size[1], size[0]), dtype=wp.vec3)
            wp.launch(draw_sheet, dim=picture.shape, inputs=[*seen, picture])
            pixels = np.asarray(np.rint(picture.numpy() * 255.0), dtype=np.uint8)
        return Shot(pixels, lens.metres_per_pixel)

    def _strokes(self, lens: Lens, used: Sequence[Points], balls: Particles, everything: Points) -> Strokes:
        """Return all lines and balls, nearest first."""
        depth = lens.places(everything)[:, 2]
        depths = float(depth.min()), float(depth.max())
        wires = zip(self._cages, used, self._colors, strict=True)
        lines = [wire_strokes(lens, cage, points, colors, depths) for cage, points, colors in wires]
        return Strokes.by_depth([*lines, ball_strokes(lens, balls, depths)])

    def _floor(self, used: Points, everything: Points, studio: Studio) -> Floor:
        """Bake the shadow of closed walls, and lighten it as far as a net lets the light through."""
        # The mesh must outlive the launch that knows its id.
        mesh = wp.Mesh(vectors(used), self._triangles)
        scene = Scene()
        scene.mesh = mesh.id
        scene.colors = self._walls
        scene.finishes = opaque(len(self._walls))
        light_directions(scene, studio, self._directions)
        floor = bake_floor(everything, scene, studio.floor)
        shade: Any = floor.shade
        net: Any = wp.array(1.0 - NET_SHADOW * (1.0 - shade.numpy()), dtype=wp.vec3)
        floor.shade = net
        return floor


def _sheet(strokes: Strokes, size: tuple[int, int]) -> Sheet:
    """Lay strokes out on a picture of some size (pixels), on the current device."""
    starts, order = strokes_by_tile(*strokes.boxes, size)
    sheet = Sheet()
    sheet.ends = wp.array(strokes.ends, dtype=wp.vec4)
    sheet.reach = wp.array(strokes.reach, dtype=wp.float32)
    sheet.paint = wp.array(strokes.paint, dtype=wp.vec4)
    sheet.is_ball = wp.array(strokes.is_ball, dtype=wp.int32)
    sheet.tile, sheet.across = TILE, tiles_across(size[0])
    sheet.starts = wp.array(starts, dtype=wp.int32)
    sheet.order = wp.array(order, dtype=wp.int32)
    return sheet
