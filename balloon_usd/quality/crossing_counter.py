"""Counting the crossings of one surface in some frames, or in many."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.quality.crossings import pierced_triangles
from balloon_usd.quality.pierced_walls import crossings_in, depth_in, folded_in_necks
from balloon_usd.quality.threads import walls_alone

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.quality.crossings import Pierced
    from balloon_usd.quality.pierced_search import PiercedSearch
    from balloon_usd.quality.pierced_walls import Crossings
    from balloon_usd.quality.walls import Walls

    Numbers = NDArray[np.int64]

FEW = 8
"""Frames up to which NumPy is done sooner than Warp is imported."""


class CrossingCounter:
    """Counts the crossings of walls; NumPy or Warp do so with the same result, bit for bit."""

    def __init__(self, walls: Walls, frames: int, device: str = "cpu") -> None:
        """Get ready for about so many frames; `device`: by name, that counts in many of them.

        While frames are simulated on a GPU, counting there would wait for them.

        Raises:
            DeviceUnavailable: there is no such device.
        """
        self._walls = walls
        self._search = _search(walls, device) if frames > FEW else None

    def count(self, points: Sequence[NDArray[np.float32]], neck: Numbers | None = None) -> Crossings:
        """Return the crossings of a frame.

        Args:
            points: (V, 3) float32 of every balloon, m.
            neck: joint in whose neck each vertex lies then, (V,); None where that is as in the end.
        """
        return crossings_in(*self._pierced(_joined(points), neck))

    def depth(self, points: Sequence[NDArray[np.float32]], neck: Numbers | None = None) -> float:
        """Return how deep the deepest vertex at a crossing of a frame lies inside a wall, m; as `count`."""
        joined = _joined(points)
        return depth_in(*self._pierced(joined, neck), joined.astype(np.float64))

    def in_necks(self, points: Sequence[NDArray[np.float32]]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return the edges of a frame that pierce faces in the neck of one joint, (P, 2) vertices of all
        balloons, and these joints, (P,).
        """
        return folded_in_necks(*self._pierced(_joined(points)))

    def _pierced(self, points: NDArray[np.float32], neck: Numbers | None = None) -> tuple[Walls, Pierced]:
        """Return the walls as they are in a frame, and what is pierced there."""
        pierced = walls_alone(self._search_in(points), self._walls.quads, points)
        walls = self._walls if neck is None else self._walls._replace(neck=neck)
        return walls.cut_off(points), pierced

    def _search_in(self, points: NDArray[np.float32]) -> Pierced:
        if self._search is not None:
            return self._search.find(points)
        faces = np.tile(self._walls.quads, (2, 1))
        return pierced_triangles(points.astype(np.float64), self._walls.triangles, faces)


def _joined(points: Sequence[NDArray[np.float32]]) -> NDArray[np.float32]:
    return np.concatenate(points) if len(points) > 1 else points[0]


def _search(walls: Walls, device: str) -> PiercedSearch | None:
    """Return what searches on a device; None where Warp was built without a backend for CPUs, and NumPy does
    it.
    """
    from balloon_usd.quality.pierced_search import PiercedSearch  # noqa: PLC0415
    from balloon_usd.solver.device import device_named, has_backend, start_warp  # noqa: PLC0415

    start_warp()
    if not has_backend(device):
        return None
    return PiercedSearch(walls.quads, device_named(device))
