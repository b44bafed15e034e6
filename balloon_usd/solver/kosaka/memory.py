"""Bend memory of the thesis's model: springs that were held bent keep part of their length."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.solver.kosaka.scene import KosakaScene

BEND_SET = 0.7
"""Share of the bending strain that stays."""


def set_bend(scene: KosakaScene, body: int, faces: NDArray[np.int64]) -> None:
    """Make part of the present curve of a bubble its own shape.

    The natural length of every spring along the bubble changes by how much more or less than its ring's mean
    it is stretched.

    `faces`: quads of the bubble, (rings * around,) in order round each ring, numbered within the body.
    """
    around = scene.bodies[body].rings[0].around
    quads = scene.quads.numpy()[faces + int(scene.quad_start[body])]
    x = scene.x.numpy().astype(np.float64)
    ends, natural = scene.spring_ends.numpy(), scene.natural.numpy()
    near, far = quads[:, 0], quads[:, 3]
    size = np.linalg.norm(x[far] - x[near], axis=1).reshape(-1, around)
    grown = ((size / size.mean(axis=1, keepdims=True)) ** BEND_SET).reshape(-1)
    for here, there in ((near, far), (far, near)):
        slot = (ends[here] == there[:, None]).argmax(axis=1)
        natural[here, slot] *= grown
    scene.natural.assign(natural)
