"""Who draws a stage: as latex, or as wire when that is its look."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.preview.cage import Cage
from balloon_usd.preview.raycast import Raycaster
from balloon_usd.preview.surface import SmoothSurface
from balloon_usd.preview.wireframe import Wireframe
from balloon_usd.stage.looks import THESIS

if TYPE_CHECKING:
    from balloon_usd.preview.read_stage import StageScene


def painter_of(scene: StageScene, device: str) -> Raycaster | Wireframe:
    """Prepare the drawing of a stage's frames on a device.

    Raises:
        PreviewError: there is no such device.
    """
    colors = [mesh.colors for mesh in scene.meshes]
    if scene.look == THESIS:
        cages = [Cage(mesh.face_counts, mesh.corners) for mesh in scene.meshes]
        return Wireframe(cages, colors, device=device)
    surfaces = [SmoothSurface(mesh.face_counts, mesh.corners) for mesh in scene.meshes]
    return Raycaster(surfaces, colors, device=device)
