"""Bend memory of the thesis's model: springs that were held bent keep part of their length."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.solver.kosaka.scene import KosakaScene

BEND_SET = 0.7
"""Share of the bending strain that stays in a bubble that was bent."""
LOOP_SET = 1.0
"""The same in a loop: its springs then carry the air's push as those of a straight tube do, in a ring."""

SHORTEST = 0.2
"""Shortest natural length that remains of any spring."""


def set_bend(scene: KosakaScene, body: int, faces: NDArray[np.int64], share: float) -> None:
    """Make a share of the present curve of a bubble its own shape.

    The natural length of every spring along the bubble changes by how much longer or shorter than its ring's
    mean it is.

    `faces`: quads of the bubble, (rings * around,) in order round each ring, numbered within the body.
    """
    around = scene.bodies[body].rings[0].around
    quads = scene.quads.numpy()[faces + int(scene.quad_start[body])]
    x = scene.x.numpy().astype(np.float64)
    ends, natural = scene.spring_ends.numpy(), scene.natural.numpy()
    near, far = quads[:, 0], quads[:, 3]
    size = np.linalg.norm(x[far] - x[near], axis=1).reshape(-1, around)
    longer = share * (size - size.mean(axis=1, keepdims=True)).reshape(-1)
    for here, there in ((near, far), (far, near)):
        slot = (ends[here] == there[:, None]).argmax(axis=1)
        now = natural[here, slot]
        natural[here, slot] = np.maximum(now + longer, SHORTEST * now)
    scene.natural.assign(natural)
