"""Rubber that necks hide: a bubble has it until its neck is closed, and gets it back when that opens."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Chambers, Rubber
from balloon_usd.solver.kernels.arrays.shared import Mesh


@wp.kernel
def hide_neck_rubber(mesh: Mesh, chambers: Chambers, rubber: Rubber):
    """Make the wall of every segment as long along the tube as its necks leave it, and of as much rubber."""
    q = wp.tid()
    length = chambers.rest_length[mesh.quad_segment[q]]
    before = rubber.quad_length[q]
    if length == before:
        return
    grown = length / before
    inverse = rubber.rest_inverse[q]
    rubber.rest_inverse[q] = wp.mat22(
        inverse[0, 0], inverse[0, 1] / grown, inverse[1, 0], inverse[1, 1] / grown
    )
    rubber.rubber_volume[q] = grown * rubber.rubber_volume[q]
    rubber.quad_length[q] = length
