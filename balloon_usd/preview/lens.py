"""From points in space to places on a picture."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    from balloon_usd.preview.camera import Axes, Framing
    from balloon_usd.preview.subdivide import Points

    Numbers32 = npt.NDArray[np.float32]


@dataclass(frozen=True)
class Lens:
    """A camera and the size of its picture."""

    axes: Axes
    framing: Framing
    size: tuple[int, int]
    """Width and height (pixels)."""

    @property
    def metres_per_pixel(self) -> float:
        """Scale in the plane through the middle of the sculpture."""
        return 2.0 * self.framing.half_height * self.framing.distance / self.size[1]

    def places(self, points: Points) -> Points:
        """Return where points (N, 3) lie on the picture: columns x and y (pixels, y down), depth (m)."""
        local = points - self.framing.eye
        depth = local @ self.axes.forward
        width, height = self.size
        x = local @ self.axes.right / (depth * self.framing.half_width)
        y = local @ self.axes.up / (depth * self.framing.half_height)
        return np.stack([0.5 * width * (1.0 + x), 0.5 * height * (1.0 - y), depth], axis=1).astype(np.float32)

    def pixels(self, lengths: Numbers32, depth: Numbers32) -> Numbers32:
        """Return how large lengths (N,) across the view are at depths (N,) (m)."""
        per_metre = self.size[1] / (2.0 * self.framing.half_height * depth)
        return np.asarray(lengths * per_metre, dtype=np.float32)

    def towards(self, points: Points) -> Points:
        """Return the unit vectors (N, 3) from points to the eye."""
        ways = self.framing.eye - points
        return np.asarray(ways / np.linalg.norm(ways, axis=1, keepdims=True), dtype=np.float32)
