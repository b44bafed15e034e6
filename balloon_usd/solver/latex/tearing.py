"""Tearing the wall of a bubble: rows of its faces are gone, and its rags snap back to their joints."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.tube_mesh import TORN_ROWS
from balloon_usd.solver.severed import Severed
from balloon_usd.solver.torn import Tear, TornBubble

if TYPE_CHECKING:
    from balloon_usd.solver.latex.sculpture import LatexSculpture

FOLDED = [0, 1, 1, 0], [3, 2, 2, 3]
"""Corners of faces that are gone, by those that they had: they lie on the rims of both rags, without area, so
that nothing touches them.
"""


def tear(bubble: str, segment: int, sculpture: LatexSculpture) -> None:
    """Tear a bubble in the middle: what is gone has neither rubber nor area, and frames do not show it.

    `segment`: that of the bubble, in the scene.
    """
    scene = sculpture.scene
    body, faces = sculpture.faces(bubble)
    torn = Tear.of(scene.bodies[body], faces)
    first_face, first_vertex = int(scene.quad_start[body]), int(scene.vertex_start[body])
    gone = torn.faces + first_face
    quads = scene.quads.numpy()
    rims = quads[gone[0]][:, FOLDED[0]], quads[gone[-1]][:, FOLDED[1]]
    half = (TORN_ROWS + 1) // 2
    quads[gone[:half]], quads[gone[half:]] = rims
    scene.quads.assign(quads)
    for array in (scene.rubber_volume, scene.hourglass):
        values = array.numpy()
        values[gone] = 0.0
        array.assign(values)
    speed = scene.v.numpy()
    speed[torn.rings[1:-1] + first_vertex] = 0.0
    scene.v.assign(speed)
    sculpture.weigh_nothing(body, torn.rings[1:-1].ravel())
    sculpture.severed[bubble] = Severed(body - sculpture.bodies[0], torn)
    own = np.flatnonzero(scene.vertex_segment.numpy() == segment)
    sculpture.torn.append(TornBubble(segment, own))
