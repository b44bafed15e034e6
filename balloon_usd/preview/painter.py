"""Who draws a stage: as latex, foil or clay, or as wire when its material leaves nothing else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.preview.cage import Cage
from balloon_usd.preview.raycast import Raycaster
from balloon_usd.preview.surface import SmoothSurface
from balloon_usd.preview.wireframe import Wireframe

if TYPE_CHECKING:
    from balloon_usd.preview.camera import View
    from balloon_usd.preview.read_stage import StageScene
    from balloon_usd.preview.shot import Shot


class Painter:
    """Draws the moments of one stage; prepared once."""

    def __init__(self, scene: StageScene, device: str) -> None:
        """Prepare the drawing on a device.

        Raises:
            PreviewError: there is no such device.
        """
        self._scene = scene
        colors = [mesh.colors for mesh in scene.meshes]
        self._drawn: Raycaster | Wireframe
        if all(mesh.wire for mesh in scene.meshes):
            cages = [Cage(mesh.face_counts, mesh.corners) for mesh in scene.meshes]
            self._drawn = Wireframe(cages, colors, device=device)
            return
        surfaces = [SmoothSurface(mesh.face_counts, mesh.corners) for mesh in scene.meshes]
        finishes = [mesh.finishes for mesh in scene.meshes]
        self._drawn = Raycaster(surfaces, colors, finishes, device=device)

    def shoot(self, moment: float, view: View, size: tuple[int, int]) -> Shot:
        """Draw the stage at a time code.

        Raises:
            PreviewError: its points, particles or colours are not right.
        """
        scene = self._scene
        if isinstance(self._drawn, Raycaster):
            self._drawn.paint(scene.vertex_colors(moment))
        return self._drawn.shoot(scene.points(moment), view, size, scene.particles(moment))
