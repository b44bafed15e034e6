"""The studio and the camera as the kernels know them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp

from balloon_usd.preview.error import PreviewError
from balloon_usd.preview.kernels.raycast import Camera, Scene, measure_studio
from balloon_usd.preview.kernels.studio import Studio
from balloon_usd.preview.lighting import SOFTBOXES, level, softbox_axes

if TYPE_CHECKING:
    from balloon_usd.preview.camera import Axes, Framing
    from balloon_usd.preview.subdivide import Points

CLEARANCE = 1.0e-4
"""Gap between the lowest point and the floor (m)."""
REACH = 1.0e5
"""Distance from the origin (m) within which everything must lie: a ray ends at ten times that."""


def studio_of(axes: Axes, lowest: float) -> Studio:
    """Set up the lamps for a camera above a floor below the lowest point (m)."""
    studio = Studio()
    studio.floor = lowest - CLEARANCE
    studio.ahead = wp.vec3(*level(axes.forward))
    for box in SOFTBOXES:
        centre, right, up = softbox_axes(box, axes.forward)
        setattr(studio, box.name, wp.vec3(*centre))
        setattr(studio, f"{box.name}_right", wp.vec3(*right))
        setattr(studio, f"{box.name}_up", wp.vec3(*up))
        setattr(studio, f"{box.name}_radiance", box.radiance)
    return studio


def camera_of(framing: Framing, axes: Axes) -> Camera:
    """Stand the kernels' camera where the framing says."""
    camera = Camera()
    camera.eye = wp.vec3(*framing.eye)
    camera.forward = wp.vec3(*axes.forward)
    camera.right = wp.vec3(*(axes.right * framing.half_width))
    camera.up = wp.vec3(*(axes.up * framing.half_height))
    return camera


def light_directions(scene: Scene, studio: Studio, directions: Any) -> None:
    """Measure what the empty studio sends from unit directions on the current device."""
    scene.directions = directions
    scene.radiances = wp.empty(len(directions), dtype=wp.float32)
    wp.launch(measure_studio, dim=len(directions), inputs=[studio, directions, scene.radiances])


def require_within_reach(points: Points) -> None:
    """Refuse points (V, 3) that no camera can see.

    Raises:
        PreviewError: one is not finite, or farther from the origin than a ray goes.
    """
    if not np.isfinite(points).all():
        raise PreviewError("there are points that are not finite")
    if np.abs(points).max(initial=0.0) > REACH:
        raise PreviewError(f"there are points farther than {REACH:g} m from the origin")
