"""Which points lie inside closed walls, by their winding numbers."""

# mypy: disable-error-code="valid-type,attr-defined,index,no-untyped-def,no-untyped-call"

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

ACCURACY = wp.constant(4.0)
"""Distance, in radii of a cluster of faces, from which its solid angle is that of a dipole (Barill 2018)."""
HALF = wp.constant(0.5)
"""Winding number from which on a point is inside."""


@wp.kernel
def find_inside(mesh: wp.uint64, points: wp.array[wp.vec3], reach: float, inside: wp.array[wp.bool]):
    """Say of each point whether the walls wind round it; `reach` is at least as far as the nearest wall."""
    i = wp.tid()
    found = wp.mesh_query_point_sign_winding_number(mesh, points[i], reach, ACCURACY, HALF)
    inside[i] = found.sign < 0.0


def inside_walls(
    at: NDArray[np.float64], points: NDArray[np.float64], triangles: NDArray[np.int64]
) -> NDArray[np.bool_]:
    """Return whether each place of `at`, (P, 3) m, is inside closed surfaces, (P,).

    `points`: (V, 3), m. `triangles`: (T, 3), normals outwards.
    """
    reach = float(np.linalg.norm(np.ptp(np.concatenate([at, points]), axis=0)))
    with wp.ScopedDevice("cpu"):
        corners: Any = wp.array(triangles.astype(np.int32).ravel(), dtype=wp.int32)
        # The mesh must outlive the launch that knows its id.
        mesh = wp.Mesh(_vectors(points), corners, support_winding_number=True)
        inside: Any = wp.empty(len(at), dtype=wp.bool)
        wp.launch(find_inside, dim=len(at), inputs=[mesh.id, _vectors(at), reach, inside])
        return np.asarray(inside.numpy())


def _vectors(rows: NDArray[np.float64]) -> Any:
    return wp.array(rows.astype(np.float32), dtype=wp.vec3)
