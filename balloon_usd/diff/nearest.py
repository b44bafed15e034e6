"""How far a surface is from another one with other vertices."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp

from balloon_usd.preview.device import drawing_device, vectors
from balloon_usd.preview.kernels.nearest import distances_to

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.preview.surface import SmoothSurface

    Points = NDArray[np.float32]


def surface_distances(
    before: SmoothSurface, old: Points, after: SmoothSurface, new: Points, device: str
) -> NDArray[np.float64]:
    """Return how far the points of a cage that faces name are from another cage, both as smooth as drawn (m).

    Args:
        before: faces of the other cage.
        old: (U, 3) its points, m.
        after: faces of the cage.
        new: (V, 3) its points, m.
        device: as of `Raycaster`.

    Returns:
        (N,), in the order of `after.used_points`.
    """
    corners = before.quads[:, [0, 1, 2, 0, 2, 3]].astype(np.int32)
    smooth_old, smooth_new = before.refine(old), after.refine(new)[: after.cage_count]
    everything = np.concatenate([smooth_old, smooth_new])
    reach = float(np.linalg.norm(np.ptp(everything, axis=0)))
    with wp.ScopedDevice(drawing_device(device)):
        # The mesh must outlive the launch that knows its id.
        mesh = wp.Mesh(vectors(smooth_old), wp.array(corners.ravel(), dtype=wp.int32))
        found: Any = wp.empty(len(smooth_new), dtype=wp.float32)
        wp.launch(distances_to, dim=len(smooth_new), inputs=[mesh.id, vectors(smooth_new), reach, found])
        rows = found.numpy()
    return np.asarray(rows, dtype=np.float64)
