"""Bend memory: rubber that was held bent keeps part of its curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.solver.latex.scene import LatexScene

BEND_SET = 0.7
"""Share of the bending strain that stays: twisters squeeze the inside of a bend until it keeps (judged by
eye).
"""


def set_bend(scene: LatexScene, body: int, faces: NDArray[np.int64]) -> None:
    """Make part of the present curve of a bubble its own shape.

    The unstressed length of every face along the tube changes by how much more or less than its ring it is
    stretched;
    the rubber's volume stays.

    `faces`: quads of the bubble, (rings * around,) in order round each ring, numbered within the body.
    """
    b = scene.bodies[body]
    around = b.rings[0].around
    index = faces + int(scene.quad_start[body])
    rest_inverse = scene.rest_inverse.numpy()
    volume = scene.rubber_volume.numpy()
    x = scene.x.numpy().astype(np.float64)[scene.quads.numpy()[index]]
    axial = 0.5 * (x[:, 3] - x[:, 0] + x[:, 2] - x[:, 1])
    stretch = (np.linalg.norm(axial, axis=1) * rest_inverse[index, 1, 1]).reshape(-1, around)
    grown = (stretch / stretch.mean(axis=1, keepdims=True)).reshape(-1) ** BEND_SET
    rest_inverse[index, :, 1] /= grown[:, None].astype(np.float32)
    volume[index] *= grown.astype(np.float32)
    scene.rest_inverse.assign(rest_inverse)
    scene.rubber_volume.assign(volume)
