"""Points of a USD stage: particles at any time code."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom
from balloon_usd.preview.error import PreviewError
from balloon_usd.preview.particles import Particles
from balloon_usd.preview.stage_color import UNPAINTED

if TYPE_CHECKING:
    import numpy.typing as npt

    from balloon_usd.preview.stage_place import World

UNSIZED = 0.01
"""Width of points that have none authored, as a share of the room they take: USD's own is one whole unit."""


@dataclass(frozen=True)
class StageCloud:
    """A `UsdGeom.Points` prim; its points may come and go."""

    path: str
    prim: Any

    def particles_at(self, time_code: float, world: World) -> Particles:
        """Return the particles at the time code of a world.

        Raises:
            PreviewError: there are widths or colours for another number of points.
        """
        cloud = UsdGeom.Points(self.prim)
        points = np.asarray(cloud.GetPointsAttr().Get(time_code) or [], dtype=np.float64).reshape(-1, 3)
        if not len(points):
            return Particles.none()
        unsized = [UNSIZED * float(np.ptp(points, axis=0).max())]
        widths = self._each(cloud.GetWidthsAttr().Get(time_code) or unsized, len(points), "widths", time_code)
        painted = cloud.GetDisplayColorPrimvar().ComputeFlattened(time_code) or [UNPAINTED]
        colors = self._each(painted, len(points), "colours", time_code)
        return Particles(
            world.place(self.prim, points),
            world.enlarge(self.prim, 0.5 * widths),
            colors.astype(np.float32),
        )

    def _each(self, values: Any, count: int, what: str, time_code: float) -> npt.NDArray[np.float64]:
        """Return a value for each of `count` points: one for all, or one each."""
        found = np.asarray(values, dtype=np.float64)
        if len(found) == 1:
            return np.repeat(found, count, axis=0)
        if len(found) != count:
            have = f"{len(found)} {what} for {count} points"
            raise PreviewError(f"{self.path} has {have} at time code {time_code:g}")
        return found
